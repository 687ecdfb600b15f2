#pragma once

#include <string>

#include "vsplit/mrr/record_block.h"

namespace vsplit {

/// What is wrong with a block, which goes by its first record.
[[nodiscard]] Error corrupt_block(const RecordBlock& block, const std::string& what);

/// What holds for every encoding: the payload's size, the numbers of the records, the checksum.
[[nodiscard]] Status check_block(const RecordBlock& block);

}  // namespace vsplit
