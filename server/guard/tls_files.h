#pragma once

#include <functional>
#include <string>

#include "vsplit/base/expected.h"

namespace vsplit::guard {

/// Files of TLS, PEM each; all empty: none. They are read again when they change.
struct TlsFiles {
    std::string cert;       ///< the server's certificate and those between it and its authority
    std::string key;        ///< its private key
    std::string client_ca;  ///< authorities whose certificates clients must show; empty: clients need none
};

/// Hears of a file that was read anew: an error, and the file is used as it was, or none.
using ReloadObserver = std::function<void(const std::string& file, const Status& read)>;

}  // namespace vsplit::guard
