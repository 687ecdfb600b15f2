import type { ColourBy } from "../shared/colours";
import { problemOf, problemText } from "../shared/problem";
import { readPlace } from "./address";
import { element, find, passFocus } from "./dom";
import { fetchFile } from "./download";
import { MethodForm } from "./form";
import { Incoming } from "./incoming";
import { KeptFields } from "./kept_fields";
import { hideProblem, showProblem, startProblems } from "./problems";
import { glossary } from "./quality_panel";
import { samples } from "./samples";
import { formatLabel, formatsOf, methodOptions, type Contract } from "./schema";
import { startTheme } from "./theme";
import { startToken } from "./token";
import { Viewer, type View } from "./viewer";
import { Workbench } from "./workbench";

const verbs = ["improve", "control"] as const;
const viewer = new Viewer(find("canvas"));
const forms: MethodForm[] = [];
const fields = new KeptFields(find("steps"));
let started: MethodForm | undefined;
const bench: Workbench = new Workbench(
  viewer,
  (problem) => {
    update();
    if (problem?.field) started?.blame(problem.field);
  },
  (session, unit, name) => {
    const sample = samples.find((one) => one.name === name);
    const another = fields.session !== "" && fields.session !== session && !incoming.repeats;
    for (const form of forms) {
      if (another) form.begin();
      form.suggest(sample?.options ?? {});
      form.unit = unit;
    }
    find("sample-note").textContent = sample?.note ?? "";
    fields.open(session);
  },
);
const incoming: Incoming = new Incoming(bench, () => update());
bench.remedies = () => incoming.remedies();

/** What can be done now. */
function update(): void {
  forms.forEach((form, n) => {
    form.enabled = bench.ready && !incoming.busy;
    form.used(bench.used(verbs[n]!));
  });
  find("apply").setAttribute("aria-disabled", String(!incoming.canRepeat));
  const link = find<HTMLAnchorElement>("download");
  const path = bench.file(find<HTMLSelectElement>("format").value);
  link.setAttribute("aria-disabled", String(path === undefined));
  if (path) link.href = path;
  else link.removeAttribute("href");
}

function startTools(): void {
  find("view").addEventListener("change", (event) => viewer.show((event.target as HTMLSelectElement).value as View));
  find("colour").addEventListener("change", (event) => bench.colour((event.target as HTMLSelectElement).value as ColourBy));
  find("edges").addEventListener("change", (event) => viewer.showEdges((event.target as HTMLInputElement).checked));
  find("fit").addEventListener("click", () => viewer.fit());
  const axis = find<HTMLSelectElement>("cut-axis"), share = find<HTMLInputElement>("cut"), place = find("cut-place"), flip = find("cut-flip");
  const cut = (): void => {
    if (axis.value === "") passFocus(share, axis);
    share.disabled = axis.value === "";
    for (const one of [share, place, flip]) one.hidden = axis.value === "";
    viewer.cut(axis.value === "" ? undefined : Number(axis.value), Number(share.value), flip.getAttribute("aria-pressed") === "true");
    if (axis.value !== "") place.textContent = `${"xyz"[Number(axis.value)]} = ${bench.coordinate(Number(axis.value), Number(share.value))}`;
  };
  viewer.shown = (view) => {
    find<HTMLSelectElement>("view").value = view;
    bench.show(view);
  };
  viewer.uncut = () => {
    axis.value = "";
    cut();
  };
  axis.addEventListener("change", cut);
  share.addEventListener("input", cut);
  flip.addEventListener("click", () => {
    flip.setAttribute("aria-pressed", String(flip.getAttribute("aria-pressed") !== "true"));
    cut();
  });
  cut();
  find("glossary").append(glossary());
}

async function startForms(): Promise<void> {
  const response = await fetch("openapi.json");
  if (!response.ok) throw await problemOf(response);
  const contract = (await response.json()) as Contract;
  for (const verb of verbs) {
    const title = verb === "improve" ? "Improve" : "Control";
    const form: MethodForm = new MethodForm(find<HTMLFormElement>(verb), title, methodOptions(contract, `${title}Options`), (options) => {
      hideProblem();
      for (const other of forms) if (other !== form) other.blame(undefined);
      started = form;
      bench.run(verb, options);
    });
    forms.push(form);
  }
  const format = find<HTMLSelectElement>("format");
  for (const name of formatsOf(contract)) format.append(element("option", { value: name }, formatLabel(name)));
  format.addEventListener("change", update);
  update();
  find("download").addEventListener("click", (event) => {
    const path = bench.file(format.value);
    event.preventDefault();
    if (path) fetchFile(path, bench.fileStem).catch((error: unknown) => showProblem(problemText(error)));
  });
}

function reopen(): void {
  incoming.giveUp();
  bench
    .reopen()
    .catch((error: unknown) => showProblem(problemText(error)))
    .finally(update);
}

startToken(() => {
  hideProblem();
  if (readPlace().session) reopen();
});
startTheme((background) => viewer.background(background));
addEventListener("hashchange", () => {
  if (bench.isAt(readPlace())) return;
  hideProblem();
  reopen();
});
startProblems();
startTools();
startForms()
  .then(() => {
    if (!readPlace().session) fields.open("");
    reopen();
  })
  .catch((error: unknown) => showProblem(problemText(error)));
