#include "store/first_page.h"

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <string>
#include <system_error>

#include "service/disk_error.h"
#include "store/new_index.h"

namespace vsplit::store {
namespace {

namespace fs = std::filesystem;

// Places in the header (SQLite file format, 1.3).
constexpr std::size_t kHeader = 100;
constexpr std::size_t kPageSize = 16;
constexpr std::size_t kSizeIsValidFor = 92;

Error failure(int number) { return service::disk_error("cannot copy a damaged index", number); }

std::size_t page_size(const std::string& header) {
    const auto byte = [&header](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(header[at])); };
    const std::size_t size = byte(kPageSize) << 8 | byte(kPageSize + 1);
    return size == 1 ? 65536 : size;
}

/// Of a new index, which is made in `place` and removed.
Expected<std::string> new_first_page(const fs::path& place) {
    if (Status made = make_index(place, {}); !made) return made.error();
    std::string page(kHeader, '\0');
    std::ifstream file(place, std::ios::binary);
    file.read(page.data(), static_cast<std::streamsize>(page.size()));
    page.resize(page_size(page));
    file.seekg(0);
    if (!file.read(page.data(), static_cast<std::streamsize>(page.size()))) return failure(EIO);
    // The size in the header is the new index's: SQLite takes the file's where they do not belong together.
    page[kSizeIsValidFor] = static_cast<char>(page[kSizeIsValidFor] ^ 1);
    std::error_code failed;
    remove_index(place, failed);
    if (failed) return failure(failed.value());
    return page;
}

Status copy_with_first_page(const fs::path& index, const fs::path& copy, const std::string& page) {
    std::error_code failed;
    fs::copy_file(index, copy, failed);
    const fs::path log = index.string() + "-wal";
    if (!failed && fs::exists(log, failed)) fs::copy_file(log, copy.string() + "-wal", failed);
    if (failed) return failure(failed.value());
    std::fstream file(copy, std::ios::binary | std::ios::in | std::ios::out);
    file.write(page.data(), static_cast<std::streamsize>(page.size()));
    file.close();
    return file ? Status(Done{}) : Status(failure(EIO));
}

}  // namespace

Status copy_with_new_first_page(const fs::path& index, const fs::path& copy) {
    std::error_code failed;
    remove_index(copy, failed);
    const Expected<std::string> page = new_first_page(copy);
    Status copied = page ? copy_with_first_page(index, copy, *page) : Status(page.error());
    if (!copied) remove_index(copy, failed);
    return copied;
}

}  // namespace vsplit::store
