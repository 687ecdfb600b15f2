import { expect, test } from "vitest";
import { formatsOf, labelOf, methodOptions, type Contract } from "../src/page/schema";

const double = { $ref: "#/components/schemas/Double" };
const contract: Contract = {
  components: {
    schemas: {
      Double: {},
      Mode: { type: "string", enum: ["MODE_UNSPECIFIED", "STRICT"] },
      MeshFormat: { type: "string", enum: ["MESH_FORMAT_UNSPECIFIED", "STL", "OBJ"] },
      ImproveOptions: {
        properties: {
          featureAngle: { ...double, description: "Degrees: an edge bends by more. 0..180, default 40." },
          tolerance: { ...double, description: "Bound of `error`. > 0. Default: half of max_deviation, or 0.1 % of the diagonal." },
          faces: { type: "integer", minimum: 0, maximum: 4294967295, description: "Resolution." },
          mode: { $ref: "#/components/schemas/Mode", description: "Default EXTENDED." },
          markedEdges: { type: "array" },
          sizing: { $ref: "#/components/schemas/Sizing" },
        },
      },
      ControlOptions: { properties: { tolerance: { ...double, description: "As in ImproveOptions." } } },
      Sizing: { properties: { chordError: { ...double, description: "> 0. Default none." }, spheres: { type: "array" } } },
    },
  },
};

test("options come from the contract: kinds, units, defaults, help", () => {
  const options = methodOptions(contract, "ImproveOptions");
  expect(options.map((o) => [o.path.join("."), o.kind, o.unit, o.standard])).toEqual([
    ["featureAngle", "number", "°", "40"],
    ["tolerance", "number", "units", "half of max_deviation, or 0.1 % of the diagonal"],
    ["faces", "whole", "", ""],
    ["mode", "choice", "", "EXTENDED"],
    ["sizing.chordError", "number", "units", "none"],
  ]);
  expect(options[2]!.bounds).toEqual([0, 4294967295]);
  expect(options[3]!.choices).toEqual(["MODE_UNSPECIFIED", "STRICT"]);
});

test("what is as in the other method is explained as there", () => {
  expect(methodOptions(contract, "ControlOptions")[0]!.help).toContain("Bound of error");
});

test("names are words", () => {
  expect(labelOf(["sizing", "chordError"])).toBe("Sizing chord error");
  expect(formatsOf(contract)).toEqual(["STL", "OBJ"]);
});
