#pragma once

#include <boost/asio/ssl/context.hpp>
#include <memory>
#include <mutex>

#include "guard/tls_files.h"
#include "guard/watched_files.h"
#include "rest/asio.h"
#include "vsplit/base/expected.h"

namespace vsplit::rest {

/// What a connection of TLS is made with: TLS 1.2 or newer, a certificate, and authorities of clients' where they need one. Made
/// anew when a file changes, at most once a second; connections that are there keep theirs. Thread-safe.
class TlsContexts {
public:
    /// \pre files.cert and files.key are named. \return INVALID_OPTION when a file cannot be used, or key and certificate do not
    /// belong together.
    [[nodiscard]] static Expected<std::shared_ptr<TlsContexts>> open(const guard::TlsFiles& files,
                                                                     guard::ReloadObserver observer);

    [[nodiscard]] std::shared_ptr<net::ssl::context> current();

private:
    TlsContexts(guard::TlsFiles files, std::shared_ptr<net::ssl::context> first, guard::ReloadObserver observer);

    const guard::TlsFiles files_;
    const guard::ReloadObserver observer_;
    std::mutex mutex_;
    guard::WatchedFiles watched_;
    std::shared_ptr<net::ssl::context> context_;
};

}  // namespace vsplit::rest
