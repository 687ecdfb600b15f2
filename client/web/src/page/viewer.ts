import { AmbientLight, Color, ColorManagement, DirectionalLight, LinearSRGBColorSpace, PerspectiveCamera, Plane, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Patch, Point } from "../shared/protocol";
import { Faces } from "./faces";
import { Marker } from "./marker";
import { faceMaterial } from "./material";
import { normalOfFaceAt, sizeAt, vantage } from "./vantage";

export type Slot = "source" | "result";
export type View = Slot | "both";

const step = 0.08;

// Colours go to the screen as the legend shows them.
ColorManagement.enabled = false;

function makeRenderer(): WebGLRenderer | undefined {
  try {
    return new WebGLRenderer({ antialias: true });
  } catch {
    return undefined;
  }
}

/** Input and result, side by side or one of them, with one camera for both. Draws when something has changed. */
export class Viewer {
  /** None where the browser has no WebGL. */
  private readonly renderer = makeRenderer();
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private readonly cutPlane = new Plane(new Vector3(1, 0, 0), Number.MAX_VALUE);
  private readonly edges = { value: 1 };
  private readonly faces: Record<Slot, Faces>;
  private readonly marker = new Marker(this.scene);
  /** How far in front of the place that is looked at everything is cut away; nothing where it is free. */
  private cutaway = Infinity;
  private near = 0.01;
  /** Told which view it is now. */
  shown: (view: View) => void = () => undefined;
  /** Called where the cut hides what is flown to. */
  uncut: () => void = () => undefined;
  private readonly ground = new Color();
  private half = new Vector3(1, 1, 1);
  private view: View = "both";
  private asked = false;
  private moved = false;
  private drawn: (() => void)[] = [];

  constructor(private readonly place: HTMLElement) {
    const material = faceMaterial(this.cutPlane, this.edges);
    this.faces = { source: new Faces(material), result: new Faces(material) };
    const light = new DirectionalLight(0xffffff, 2.2);
    light.position.set(0.4, 0.7, 1);
    this.camera.add(light);
    this.scene.add(new AmbientLight(0xffffff, 1.1), this.camera, this.faces.source.mesh, this.faces.result.mesh);
    if (this.renderer) this.start(this.renderer);
    else this.undrawn("This browser draws no WebGL, or it is switched off: meshes are not drawn. All else works.");
    this.controls = new OrbitControls(this.camera, this.renderer?.domElement ?? place);
    this.controls.addEventListener("change", () => this.ask());
    this.controls.addEventListener("start", () => (this.moved = true));
    place.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(place);
    this.arrange();
  }

  /** Half the edges of the box around the part, which lies around the origin. */
  frame(half: Point): void {
    this.half = new Vector3(...half);
    this.uncut();
    this.fit();
  }

  private start(renderer: WebGLRenderer): void {
    renderer.outputColorSpace = LinearSRGBColorSpace;
    renderer.localClippingEnabled = true;
    renderer.sortObjects = false;
    renderer.autoClear = false;
    const canvas = renderer.domElement;
    canvas.setAttribute("aria-hidden", "true");
    // The browser may take the graphics card away; three.js fills its buffers anew when it is back.
    canvas.addEventListener("webglcontextlost", () => this.undrawn("The graphics card was taken away; the picture comes back with it."));
    canvas.addEventListener("webglcontextrestored", () => {
      this.undrawn("");
      renderer.setClearColor(this.ground);
      this.ask();
    });
    this.place.append(canvas);
  }

  /** Says why nothing is drawn; "" where it is. */
  private undrawn(why: string): void {
    this.place.querySelector(".undrawn")!.textContent = why;
  }

  fit(): void {
    const radius = Math.max(this.half.length(), 1e-9);
    this.near = radius / 500;
    this.camera.far = radius * 50;
    this.cutaway = Infinity;
    this.marker.visible = false;
    this.moved = false;
    const away = new Vector3(0.55, 0.4, 1).normalize();
    this.aim(new Vector3(), away.multiplyScalar(this.distanceFrom(away)));
  }

  /** How far away in a direction the whole box is in the picture, with a margin. */
  private distanceFrom(away: Vector3): number {
    const across = new Vector3().crossVectors(this.camera.up, away).normalize(), up = new Vector3().crossVectors(away, across);
    const high = Math.tan((this.camera.fov * Math.PI) / 360), wide = high * this.camera.aspect;
    let distance = 1e-9;
    for (let n = 0; n < 8; ++n) {
      const corner = new Vector3(n & 1 ? 1 : -1, n & 2 ? 1 : -1, n & 4 ? 1 : -1).multiply(this.half);
      const outwards = Math.max(Math.abs(corner.dot(across)) / wide, Math.abs(corner.dot(up)) / high);
      distance = Math.max(distance, corner.dot(away) + 1.08 * outwards);
    }
    return distance;
  }

  /** To a point of a mesh: the middle of a face of this size, or where it is not said whatever is there. What hides it is cut away. */
  fly(slot: Slot, point: Point, size?: number): void {
    if (!this.sees(slot)) this.show(slot);
    const target = new Vector3(...point);
    if (this.cutPlane.distanceToPoint(target) < 0) this.uncut();
    const { drawn } = this.faces[slot];
    const radius = Math.max(this.half.length(), 1e-9);
    const seen = size ?? Math.min(Math.max(sizeAt(drawn, target, radius / 50) ?? 0, radius / 200), radius / 20);
    // Of a large face what is around it is mostly the part.
    const distance = Math.max(Math.min(12 * seen, Math.max(3 * seen, radius)), radius * 0.002);
    const now = this.camera.position.clone().sub(this.controls.target).normalize();
    const face = size === undefined ? undefined : normalOfFaceAt(drawn, target);
    const { away, free } = vantage(drawn, target, distance / 10, distance, now, face);
    this.cutaway = free ? Infinity : distance / 10;
    this.marker.put(target);
    this.moved = true;
    this.near = Math.min(radius / 500, distance / 120 + radius * 1e-6);
    // On a narrow page the list that leads here may be far from the picture.
    this.place.scrollIntoView({ block: "nearest" });
    this.aim(target, away.multiplyScalar(distance));
  }

  apply(slot: Slot, patch: Patch): void {
    this.faces[slot].apply(patch);
    this.place.dataset[slot] = String(patch.visible);
    this.arrange();
    this.ask();
  }

  clear(slot: Slot): void {
    this.faces[slot].mesh.visible = false;
    delete this.place.dataset[slot];
    this.arrange();
    this.ask();
  }

  show(view: View): void {
    this.view = view;
    this.shown(view);
    this.arrange();
  }

  /** Side by side takes two: before there is a result, the input has all the room. */
  private arrange(): void {
    const { dataset } = this.place;
    const view = this.view === "both" && dataset["result"] === undefined ? "source" : this.view;
    if (dataset["view"] === view) return;
    dataset["view"] = view;
    this.resize();
  }

  /** Whether it can be seen now. */
  sees(slot: Slot): boolean {
    return this.view === "both" || this.view === slot;
  }

  showEdges(shown: boolean): void {
    this.edges.value = shown ? 1 : 0;
    this.ask();
  }

  /** Hides what lies beyond `share` of the part along an axis, or before it; no axis: nothing. */
  cut(axis: number | undefined, share: number, before: boolean): void {
    const side = before ? 1 : -1;
    this.cutPlane.normal.set(axis === 0 ? side : 0, axis === 1 ? side : 0, axis === 2 ? side : 0);
    this.cutPlane.constant = axis === undefined ? 1 : -side * (2 * share - 1) * this.half.getComponent(axis) * 1.001;
    this.ask();
  }

  background(colour: string): void {
    this.ground.set(colour);
    this.renderer?.setClearColor(this.ground);
    this.ask();
  }

  /** When what was asked for last is on the screen. */
  afterDraw(): Promise<void> {
    return new Promise((resolve) => {
      this.drawn.push(resolve);
      this.ask();
    });
  }

  private aim(target: Vector3, away: Vector3): void {
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(away);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.ask();
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return; // the browser's
    const around: Record<string, [number, number]> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
    const zoom: Record<string, number> = { "+": 0.9, "=": 0.9, "-": 1.1 };
    const away = this.camera.position.clone().sub(this.controls.target);
    const turn = around[event.key];
    if (turn) {
      away.applyAxisAngle(this.camera.up, turn[0]);
      const side = new Vector3().crossVectors(this.camera.up, away).normalize();
      away.applyAxisAngle(side, turn[1]);
    } else if (zoom[event.key]) {
      away.multiplyScalar(zoom[event.key]!);
    } else if (event.key === "f") {
      return this.fit();
    } else {
      return;
    }
    event.preventDefault();
    this.moved = true;
    this.aim(this.controls.target.clone(), away);
  }

  private ask(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw();
      for (const resolve of this.drawn.splice(0)) resolve();
    });
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer?.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer?.setSize(width, height);
    this.camera.aspect = (this.place.dataset["view"] === "both" ? width / 2 : width) / height;
    this.camera.updateProjectionMatrix();
    if (this.moved) this.ask();
    else this.fit();
  }

  /** Nothing nearer than the cutaway is drawn, wherever the eye has gone since. */
  private cutAway(): void {
    const near = Math.max(this.near, this.camera.position.distanceTo(this.controls.target) - this.cutaway);
    if (near === this.camera.near) return;
    this.camera.near = near;
    this.camera.updateProjectionMatrix();
  }

  private draw(): void {
    const { renderer } = this;
    if (!renderer) return;
    const { clientWidth: width, clientHeight: height } = this.place;
    const view = this.place.dataset["view"] as View;
    const shown: Slot[] = view === "both" ? ["source", "result"] : [view];
    this.marker.face(this.camera, height);
    this.cutAway();
    renderer.setScissorTest(true);
    shown.forEach((slot, n) => {
      const left = Math.floor((n * width) / shown.length), across = Math.ceil(width / shown.length);
      renderer.setViewport(left, 0, across, height);
      renderer.setScissor(left, 0, across, height);
      renderer.clear();
      for (const other of ["source", "result"] as const) this.faces[other].mesh.visible = other === slot && this.place.dataset[other] !== undefined;
      renderer.render(this.scene, this.camera);
    });
  }
}
