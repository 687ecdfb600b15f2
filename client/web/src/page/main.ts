import type { ColourBy } from "../shared/colours";
import { Problem, problemOf, problemText } from "../shared/problem";
import { readPlace } from "./address";
import { upload } from "./api";
import { element, find, passFocus } from "./dom";
import { fetchFile } from "./download";
import { MethodForm } from "./form";
import { check, clear, pointAt } from "./number_field";
import { hideProblem, showProblem, startProblems } from "./problems";
import { ProgressBar } from "./progress";
import { samples } from "./samples";
import { formatLabel, formatsOf, methodOptions, type Contract } from "./schema";
import { startTheme } from "./theme";
import { startToken } from "./token";
import { Viewer, type View } from "./viewer";
import { Workbench } from "./workbench";

const viewer = new Viewer(find("canvas"));
const forms: MethodForm[] = [];
let started: MethodForm | undefined;
const bench = new Workbench(
  viewer,
  (ready, problem) => {
    for (const form of forms) form.enabled = ready && sending === undefined;
    if (problem?.field) started?.blame(problem.field);
    updateDownload();
  },
  (name) => {
    const sample = samples.find((one) => one.name === name);
    for (const form of forms) form.suggest(sample?.options ?? {});
    find("sample-note").textContent = sample?.note ?? "";
  },
);

function updateDownload(): void {
  const link = find<HTMLAnchorElement>("download");
  const path = bench.file(find<HTMLSelectElement>("format").value);
  link.setAttribute("aria-disabled", String(path === undefined));
  if (path) link.href = path;
}

let sending: AbortController | undefined;

function giveUpSending(): void {
  sending?.abort();
  sending = undefined;
}

function enableForms(): void {
  for (const form of forms) form.enabled = bench.ready && sending === undefined;
}

/** Uploads a mesh; one that is still on its way gives way to it. */
async function send(get: (signal: AbortSignal) => Promise<Blob>, name: string, sample?: string): Promise<void> {
  const weld = find<HTMLInputElement>("weld");
  clear(weld);
  if (!check(weld, "Weld")) return;
  hideProblem();
  giveUpSending();
  const stop = (sending = new AbortController());
  enableForms();
  const progress = new ProgressBar(find("upload"), () => find("file"), () => stop.abort());
  progress.show("upload", 0);
  try {
    const options = { repair: find<HTMLSelectElement>("repair").value, weld: Number(weld.value), unit: find<HTMLSelectElement>("unit").value };
    const session = await upload(await get(stop.signal), options, (share) => progress.show(share < 1 ? "upload" : "inspect", share), stop.signal);
    if (sending === stop) bench.replace(session, name, sample);
  } catch (error) {
    if (sending !== stop) return;
    const problem = problemText(error);
    showProblem(problem);
    if (problem.field === "weld") pointAt(weld);
  } finally {
    progress.hide();
    if (sending === stop) sending = undefined;
    enableForms();
  }
}

async function fetchSample(name: string, signal: AbortSignal): Promise<Blob> {
  const response = await fetch(`samples/${name}`, { signal });
  if (!response.ok) throw new Problem({ cause: "NOT_FOUND", detail: `the server has no sample ${name}` });
  return response.blob();
}

function startSamples(): void {
  let coming: string | undefined;
  for (const { name } of samples) {
    const button = element("button", { type: "button", class: "quiet" }, name);
    button.addEventListener("click", (event) => {
      // Two clicks in a row ask once.
      if (event.detail > 1 || coming === name) return;
      coming = name;
      void send((signal) => fetchSample(name, signal), name, name).finally(() => {
        if (coming === name) coming = undefined;
      });
    });
    find("samples").append(button);
  }
}

function startUpload(): void {
  const input = find<HTMLInputElement>("file");
  const take = (files: FileList | null | undefined): void => {
    const file = files?.[0];
    if (file) void send(() => Promise.resolve(file), file.name);
  };
  input.addEventListener("change", () => {
    take(input.files);
    input.value = "";
  });
  const body = document.body;
  body.addEventListener("dragover", (event) => {
    event.preventDefault();
    body.classList.add("dragging");
  });
  body.addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) body.classList.remove("dragging");
  });
  body.addEventListener("drop", (event) => {
    event.preventDefault();
    body.classList.remove("dragging");
    take(event.dataTransfer?.files);
  });
}

function startTools(): void {
  find("view").addEventListener("change", (event) => viewer.show((event.target as HTMLSelectElement).value as View));
  find("colour").addEventListener("change", (event) => bench.colour((event.target as HTMLSelectElement).value as ColourBy));
  find("edges").addEventListener("change", (event) => viewer.showEdges((event.target as HTMLInputElement).checked));
  find("fit").addEventListener("click", () => viewer.fit());
  const axis = find<HTMLSelectElement>("cut-axis"), share = find<HTMLInputElement>("cut");
  const cut = (): void => {
    if (axis.value === "") passFocus(share, axis);
    share.disabled = axis.value === "";
    viewer.cut(axis.value === "" ? undefined : Number(axis.value), Number(share.value));
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
  viewer.cut(undefined, 1);
}

async function startForms(): Promise<void> {
  const response = await fetch("openapi.json");
  if (!response.ok) throw await problemOf(response);
  const contract = (await response.json()) as Contract;
  for (const verb of ["improve", "control"] as const) {
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
  format.addEventListener("change", updateDownload);
  enableForms();
  find("download").addEventListener("click", (event) => {
    const path = bench.file(format.value);
    event.preventDefault();
    if (path) fetchFile(path).catch((error: unknown) => showProblem(problemText(error)));
  });
}

function reopen(): void {
  giveUpSending();
  bench
    .reopen()
    .catch((error: unknown) => showProblem(problemText(error)))
    .finally(enableForms);
}

startToken(() => {
  hideProblem();
  reopen();
});
startTheme((background) => viewer.background(background));
addEventListener("hashchange", () => {
  const place = readPlace();
  if (!place.session || bench.isAt(place)) return;
  hideProblem();
  reopen();
});
startProblems();
startUpload();
startSamples();
startTools();
startForms()
  .then(reopen)
  .catch((error: unknown) => showProblem(problemText(error)));
