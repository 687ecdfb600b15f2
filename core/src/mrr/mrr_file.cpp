#include "vsplit/mrr/mrr_file.h"

#include "base/mapped_file.h"
#include "base/write_file.h"

namespace vsplit {

Status save_mrr(const StoredMrr& stored, const std::filesystem::path& path) { return write_file(path, encode_mrr(stored)); }

Expected<StoredMrr> load_mrr(const std::filesystem::path& path) {
    const Expected<MappedFile> file = MappedFile::open(path);
    if (!file) return file.error();
    return decode_mrr(file->bytes());
}

}  // namespace vsplit
