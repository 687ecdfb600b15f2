import type { ColourBy, Range } from "./colours";

/** What went wrong, as problem+json tells it. */
export interface ProblemText {
  cause: string;
  detail: string;
  field?: string;
  retryAfter?: number;
}

export type Point = readonly [number, number, number];

/** A face or vertex of a result, numbered as the server does: only those that are seen count. */
export interface Element {
  of: "face" | "vertex";
  number: number;
}

/** Least, mean and largest of a figure; zeros where there is nothing. */
export type Spread = readonly [min: number, mean: number, max: number];

/** A face that is seen, numbered as the server does, and where its middle is. */
export interface WorstFace {
  face: number;
  stretch: number;
  /** Longest edge. */
  size: number;
  place: Point;
}

/** Figures of the mesh as a worker holds it. */
export interface Figures {
  faces: number;
  stretchMin: number;
  stretchMean: number;
  facesBelow02: number;
  sizeMax: number;
  valenceMax: number;
  /** 20 counts: faces with stretch in [i/20, (i+1)/20). */
  histogram: number[];
  /** Of faces: stretch, and longest edge; of vertices: edges. */
  spread: { stretch: Spread; size: Spread; valence: Spread };
  /** Longest edges of faces: the least above 0, and the largest. */
  sizes: Range;
  /** The worst by stretch, the worst first. */
  worst: WorstFace[];
}

/** Faces to draw anew: runs of them, and the bytes of all runs one after the other. Three corners a face, no index. */
export interface Patch {
  /** Places for faces that are drawn; those of ghosts are drawn as nothing. */
  slots: number;
  /** First and count, by turns. */
  runs: Uint32Array;
  /** 9 floats a face. */
  positions: Float32Array;
  /** 9 bytes a face. */
  colours: Uint8Array;
  /** Longest edges of the faces of these runs: the least above 0, and the largest. */
  sizes: Range;
  /** Faces that are seen. */
  visible: number;
  /** Milliseconds that the worker took, and the records it applied or undid. */
  milliseconds: number;
  records: number;
}

/** The page to a worker. */
export type Order =
  | { kind: "source"; path: string; centre: Point }
  | { kind: "method"; path: string; body: object; centre: Point }
  /** A .vsplit file, held here alone. */
  | { kind: "file"; file: Blob }
  | { kind: "open"; session: string; representation: string; faces: number; centre: Point }
  | { kind: "faces"; faces: number }
  /** To the resolution that the element is of, and where it is there. */
  | { kind: "locate"; faces: number; element: Element }
  | { kind: "colour"; by: ColourBy; range: Range }
  | { kind: "token"; token: string }
  | { kind: "cancel" };

/** A worker to the page. */
export type News =
  | { kind: "progress"; stage: string; fraction: number; faces: number }
  | { kind: "patch"; patch: Patch }
  | { kind: "figures"; figures: Figures }
  | { kind: "place"; place: Point; size: number }
  /** A file is read: what it says of itself, its levels, and the box around it, of which `half` is half. */
  | { kind: "file"; json: unknown; faces: number; facesMin: number; facesMax: number; centre: Point; half: Point }
  | { kind: "representation"; json: unknown }
  | { kind: "problem"; problem: ProblemText }
  | { kind: "idle" };
