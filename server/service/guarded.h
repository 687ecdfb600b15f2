#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>

#include "service/limits.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// Calls `make`, which returns an Expected or an Error's like, and turns what the standard library throws into an Error: a
/// request that memory does not suffice for must not take the other sessions with it.
template <class Make>
[[nodiscard]] auto guarded(Make&& make) -> decltype(make()) {
    try {
        return std::forward<Make>(make)();
    } catch (const std::bad_alloc&) {
        return Error{Cause::kLimitExceeded, "the server has not enough memory for this request; ask for fewer faces", "",
                     kRetryAfter};
    } catch (const std::exception& thrown) {
        return Error{Cause::kInternal, std::string("unexpected failure: ") + thrown.what(), ""};
    }
}

}  // namespace vsplit::service
