export { unpackBase, type BaseCounts, type BaseMesh } from "./base.js";
export { RecordDecoder, type RecordBlock } from "./block.js";
export { crc32c } from "./crc32c.js";
export { CorruptError } from "./errors.js";
export { Encoding, float32Grid, float64Grid, type Grid } from "./grid.js";
export { ProgressiveMesh } from "./mesh.js";
export { isMrrFile, MrrFile, MrrFileError, type BlockEntry, type FileFault } from "./mrr_file.js";
