// What the index of the data directory says of meshes, methods and representations: what was written, or an error, whatever the
// bytes. The first byte says which.

#include "store/stored_values.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include "check.h"

namespace {

template <class Read>
void try_read(const Read& read) {
    if (!read) vsplit::fuzz::check(!read.error().message.empty(), "an error says what is wrong");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace vsplit;
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    switch (data[0] % 3) {
        case 0:
            try_read(store::read_source(text));
            break;
        case 1: {
            const auto request = store::read_request(text);
            try_read(request);
            if (!request) break;
            const auto again = store::read_request(store::write_request(*request));
            // Not equal where a number is none: nothing equals that.
            fuzz::check(again.has_value(), "what was read can be written and read");
            break;
        }
        default:
            try_read(store::read_representation(text));
    }
    return 0;
}
