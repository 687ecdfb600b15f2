import { access } from "../shared/access";
import { find, passFocus } from "./dom";

const key = "vsplit-token";

/** The field for a token: hidden until a server asks for one, forgotten with the tab. */
export function startToken(given: () => void): void {
  const form = find<HTMLFormElement>("access"), field = find<HTMLInputElement>("token");
  access.token = sessionStorage.getItem(key) ?? "";
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    access.token = field.value.trim();
    field.value = "";
    sessionStorage.setItem(key, access.token);
    passFocus(form, find("file"));
    form.hidden = true;
    given();
  });
}

export function askForToken(): void {
  find("access").hidden = false;
  find("token").focus();
}
