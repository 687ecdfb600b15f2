import { count, counted, find, passFocus } from "./dom";

const steps = 1000;

const coarsest = "The coarsest there is: no further collapse keeps tolerance, creases and bounds, or Faces min or Min mean stretch ended it.";
const finest = "The finest there is: the mesh as it was after subdivision.";

/** The slider over all resolutions, even in the logarithm: from 400 faces to 800 is as far as from 40,000 to 80,000. */
export class ResolutionSlider {
  private readonly input = find<HTMLInputElement>("faces");
  private readonly output = find<HTMLOutputElement>("faces-shown");
  private least = 1;
  private most = 1;

  constructor(moved: (faces: number) => void) {
    this.input.addEventListener("input", () => {
      const faces = this.faces();
      this.tell(faces);
      moved(faces);
    });
  }

  set(least: number, most: number, faces: number): void {
    this.least = Math.max(1, least);
    this.most = Math.max(this.least, most);
    this.input.disabled = false;
    find("faces-least").textContent = count(this.least);
    find("faces-most").textContent = count(this.most);
    this.show(faces);
  }

  show(faces: number): void {
    const span = Math.log(this.most / this.least);
    this.input.value = span > 0 ? String(Math.round((steps * Math.log(Math.max(1, faces / this.least))) / span)) : "0";
    this.tell(faces);
  }

  tell(faces: number): void {
    this.output.textContent = counted(faces, "face");
    this.input.setAttribute("aria-valuetext", counted(faces, "face"));
    find("resolution-note").textContent = this.input.disabled ? "" : faces <= this.least ? coarsest : faces >= this.most ? finest : "";
  }

  off(): void {
    passFocus(this.input, find("canvas"));
    this.input.disabled = true;
    this.output.textContent = "–";
    for (const id of ["faces-least", "faces-most", "resolution-note"]) find(id).textContent = "";
  }

  private faces(): number {
    return Math.round(this.least * (this.most / this.least) ** (Number(this.input.value) / steps));
  }
}
