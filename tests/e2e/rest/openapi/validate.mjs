// validate.mjs: fails where the document on stdin is no OpenAPI 3.1, or has a reference that leads nowhere.
import { readFileSync } from "node:fs";
import { Validator } from "@seriousme/openapi-schema-validator";

const document = JSON.parse(readFileSync(0, "utf8"));
const validator = new Validator();
const result = await validator.validate(document);
if (!result.valid || validator.version !== "3.1") {
  console.error(`OpenAPI ${validator.version}:`, JSON.stringify(result.errors, null, 2));
  process.exit(1);
}
validator.resolveRefs();
console.log(`valid OpenAPI ${validator.version}, ${Object.keys(document.paths).length} paths`);
