// Light or dark: as the system is, or as someone chose.

const SYSTEM_DARK = matchMedia("(prefers-color-scheme: dark)");

function applyTheme(theme = document.documentElement.dataset.theme ?? "auto") {
  const dark = theme === "dark" || (theme === "auto" && SYSTEM_DARK.matches);
  Object.assign(document.documentElement.dataset, { theme, shade: dark ? "dark" : "light" });
  document.dispatchEvent(new Event("choque-theme"));
}

/** A button that goes from `auto` to `light` to `dark`. */
function themeSwitch(button) {
  const themes = ["auto", "light", "dark"];
  const apply = (theme) => {
    applyTheme(theme);
    button.textContent = `Theme: ${theme}`;
  };
  SYSTEM_DARK.addEventListener("change", () => applyTheme());
  button.addEventListener("click", () => apply(themes[(themes.indexOf(document.documentElement.dataset.theme) + 1) % 3]));
  apply("auto");
}
