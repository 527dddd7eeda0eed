// What the tests in a real browser share: finding one, finding choque, and where pictures go.

import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { delimiter, join } from "node:path";
import { fileURLToPath } from "node:url";

export const ROOT = fileURLToPath(new URL("../..", import.meta.url));

/** The browser to test with: CHOQUE_BROWSER, or one on the PATH; null where there is none. */
export function browserPath() {
  const names = ["chromium", "chromium-headless-shell", "google-chrome", "chrome"];
  const found = names.flatMap((name) => process.env.PATH.split(delimiter).map((folder) => join(folder, name))).find(existsSync);
  return process.env.CHOQUE_BROWSER ?? found ?? null;
}

/** Why these tests cannot be run here; false where they can: what `test`'s option `skip` takes. */
export const missing = await (async () => {
  if (!browserPath()) return "no Chromium is there: install one, or name it in CHOQUE_BROWSER";
  const driver = await import("puppeteer-core").catch(() => null);
  return driver ? false : "puppeteer-core is not there: npm ci --prefix tests/browser";
})();

/** A browser without a window. Whoever opens it closes it. */
export async function openBrowser() {
  const { default: puppeteer } = await import("puppeteer-core");
  const args = ["--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", "--force-color-profile=srgb"];
  return puppeteer.launch({ executablePath: browserPath(), headless: true, args });
}

/** The command: CHOQUE_BINARY, or a release build, made now when it is not there. */
export function choqueBinary() {
  if (process.env.CHOQUE_BINARY) return process.env.CHOQUE_BINARY;
  execFileSync("cargo", ["build", "--release", "--quiet", "--bin", "choque"], { cwd: ROOT, stdio: "inherit" });
  return join(ROOT, "target/release/choque");
}

/** Runs the command and gives what it said; throws when it fails, but not when `diff` finds a difference. */
export function choque(...words) {
  const { status, stdout, stderr } = spawnSync(choqueBinary(), words, { cwd: ROOT, encoding: "utf8" });
  if (status !== 0 && !(words[0] === "diff" && status === 1)) throw new Error(`choque ${words.join(" ")}: ${stderr}`);
  return stdout;
}

/** What a reading says as a number: `−12.3 kJ` is −12300. */
export function numberOf(reading) {
  const prefixes = { T: 1e12, G: 1e9, M: 1e6, k: 1e3, m: 1e-3, µ: 1e-6, n: 1e-9 };
  const [, digits, power = "", unit] = reading.replace("−", "-").match(/^(-?[\d.]+)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?\s*(.*)$/u);
  const exponent = Number([...power].map((c) => "0123456789-"["⁰¹²³⁴⁵⁶⁷⁸⁹⁻".indexOf(c)]).join(""));
  const factor = unit.length > 1 && !unit.startsWith("kg") ? (prefixes[unit[0]] ?? 1) : 1;
  return Number(digits) * factor * 10 ** exponent;
}

/** The readings beside the curves that reach over each other or out of their panel, at the page's width. */
export const crowded = (page) =>
  page.evaluate(() => {
    const room = document.querySelector(".choque-player .plots").getBoundingClientRect();
    const texts = [...document.querySelectorAll(".choque-player .plot h3, .choque-player .readings output, .choque-player .curve-name, .choque-player .lines span")]
      .filter((element) => element.textContent && element.checkVisibility())
      .map((element) => ({ text: element.textContent, box: element.getBoundingClientRect(), element }));
    const wrong = texts.filter(({ box }) => box.left < room.left - 0.5 || box.right > room.right + 0.5).map(({ text }) => `${text} sticks out`);
    for (const [k, a] of texts.entries()) {
      for (const b of texts.slice(k + 1)) {
        const wide = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left);
        const tall = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
        if (wide > 0.5 && tall > 4) wrong.push(`${a.text} covers ${b.text}`);
      }
    }
    return wrong;
  });

/** A picture of a page, under CHOQUE_ARTIFACTS or target/browser. */
export async function screenshot(page, name, options = {}) {
  const folder = process.env.CHOQUE_ARTIFACTS ?? join(ROOT, "target/browser");
  mkdirSync(folder, { recursive: true });
  const path = join(folder, `${name}.png`);
  await page.screenshot({ path, ...options });
  return path;
}
