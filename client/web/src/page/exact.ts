import type { Quality } from "../gen/vsplit/v1/meshing_pb";
import type { Figures } from "../shared/protocol";

/**
 * A worker's figures with the server's in their place where it has said them of the same faces: a worker holds positions of a result
 * in single precision, so that a face may come to lie on the other side of 0.2.
 */
export function exact(figures: Figures | undefined, said: Quality | undefined): Figures | undefined {
  if (!figures || !said || said.faces !== figures.faces) return figures;
  const { stretchMin, stretchMean, facesBelow02, sizeMax, valenceMax, stretchHistogram } = said;
  const { stretch, size, valence } = figures.spread;
  return {
    ...figures,
    stretchMin,
    stretchMean,
    facesBelow02,
    sizeMax,
    valenceMax,
    histogram: stretchHistogram.length > 0 ? stretchHistogram : figures.histogram,
    spread: { stretch: [stretchMin, stretchMean, stretch[2]], size: [size[0], size[1], sizeMax], valence: [valence[0], valence[1], valenceMax] },
  };
}
