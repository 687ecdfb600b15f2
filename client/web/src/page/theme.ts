import { find } from "./dom";

/** Light or dark: as the system is, until the button says otherwise. */
export function startTheme(changed: (background: string) => void): void {
  const button = find<HTMLButtonElement>("theme");
  const system = matchMedia("(prefers-color-scheme: dark)");
  const root = document.documentElement;
  let chosen: boolean | undefined;
  const apply = (): void => {
    const dark = chosen ?? system.matches;
    root.dataset["theme"] = dark ? "dark" : "light";
    button.textContent = dark ? "Light" : "Dark";
    button.setAttribute("aria-label", dark ? "Use light colours" : "Use dark colours");
    changed(getComputedStyle(root).getPropertyValue("--canvas").trim());
  };
  button.addEventListener("click", () => {
    chosen = root.dataset["theme"] === "light";
    apply();
  });
  system.addEventListener("change", apply);
  apply();
}
