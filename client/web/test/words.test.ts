import { expect, test } from "vitest";
import { helpWords, onPage } from "../src/page/words";

test("problems name no calls of the server", () => {
  expect(onPage('no session "x"; it may have been deleted or have expired, and CreateSession makes a new one')).toBe('no session "x"; it may have been deleted or have expired. Upload the mesh again');
  expect(onPage("the session has no mesh yet; UploadMesh gives it one")).toBe("the session has no mesh yet; upload one");
  expect(onPage("faces 3 of 4")).toBe("faces 3 of 4");
});

test("help is without symbols and documents, and names options as their fields do", () => {
  expect(helpWords("sigma_SZ: no edge is longer after subdivision. > 0. Default: the mean edge of faces (STRICT: 1 %).")).toBe("No edge is longer after subdivision. > 0. Default: the mean edge of faces (strict: 1 %).");
  const tolerance = "Bound of the quadric error of a collapse, as a length: tau_TL of the paper is tolerance^2, so tau_TL = 2.0 is a tolerance of 1.414. > 0. Default: half of max_deviation. EXTENDED bounds a mean (docs/method.md).";
  expect(helpWords(tolerance)).toBe("Bound of the quadric error of a collapse, as a length. > 0. Default: half of max deviation. Extended bounds a mean.");
});
