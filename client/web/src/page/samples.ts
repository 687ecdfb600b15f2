/** A mesh that the server has, and what suits it. */
export interface Sample {
  name: string;
  note: string;
  /** Options of both methods that are set with it, by name. */
  options: Readonly<Record<string, string>>;
}

export const samples: readonly Sample[] = [
  {
    name: "bracket.stl",
    note: "A CAD part. Some of its creases meet at 3 to 5 degrees and force slivers there: the notes on a result name them.",
    options: {},
  },
  {
    name: "scan.ply",
    note: "A scan. Feature detection is set to normal voting, under More options: by angle alone its noise would pass for creases.",
    options: { featureDetection: "NORMAL_VOTING" },
  },
];
