import { find } from "./dom";

/** Light or dark: as the system is, until the button says otherwise. */
export function startTheme(changed: (background: string) => void): void {
  const button = find<HTMLButtonElement>("theme");
  const system = matchMedia("(prefers-color-scheme: dark)");
  const root = document.documentElement;
  const apply = (): void => {
    const dark = root.dataset["theme"] === undefined ? system.matches : root.dataset["theme"] === "dark";
    button.textContent = dark ? "Light" : "Dark";
    button.setAttribute("aria-label", dark ? "Use light colours" : "Use dark colours");
    changed(getComputedStyle(root).getPropertyValue("--canvas").trim());
  };
  button.addEventListener("click", () => {
    root.dataset["theme"] = button.textContent === "Dark" ? "dark" : "light";
    apply();
  });
  system.addEventListener("change", apply);
  apply();
}
