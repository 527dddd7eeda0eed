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

/** Runs the command and gives what it said; throws when it fails. */
export function choque(...words) {
  const { status, stdout, stderr } = spawnSync(choqueBinary(), words, { cwd: ROOT, encoding: "utf8" });
  if (status !== 0) throw new Error(`choque ${words.join(" ")}: ${stderr}`);
  return stdout;
}

/** A picture of a page, under CHOQUE_ARTIFACTS or target/browser. */
export async function screenshot(page, name, options = {}) {
  const folder = process.env.CHOQUE_ARTIFACTS ?? join(ROOT, "target/browser");
  mkdirSync(folder, { recursive: true });
  const path = join(folder, `${name}.png`);
  await page.screenshot({ path, ...options });
  return path;
}
