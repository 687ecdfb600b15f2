#pragma once

#include <boost/asio/ssl/context.hpp>
#include <memory>
#include <mutex>
#include <string>

#include "guard/tls_files.h"
#include "guard/watched_files.h"
#include "vsplit/base/expected.h"

namespace vsplit::guard {

/// What connections of TLS are made with: certificate and key that belong together, and authorities of clients where they need
/// one. As text, and as OpenSSL took it: TLS 1.2 or newer.
struct TlsSet {
    std::string cert;
    std::string key;
    std::string client_ca;
    std::shared_ptr<boost::asio::ssl::context> context;
};

/// The TLS of both doors, whose files are read again when they change, at most once a second. Files that cannot be used are told
/// of and leave what there was; connections that are there keep theirs. Thread-safe.
class TlsBook {
public:
    /// \pre files.cert and files.key are named. \return INVALID_OPTION when a file cannot be used, or key and certificate do not
    /// belong together; what `read_small_file` returns.
    [[nodiscard]] static Expected<std::shared_ptr<TlsBook>> open(const TlsFiles& files, ReloadObserver observer);

    [[nodiscard]] std::shared_ptr<const TlsSet> current();

private:
    using Set = std::shared_ptr<const TlsSet>;

    TlsBook(TlsFiles files, Set first, WatchedFiles watched, ReloadObserver observer);

    [[nodiscard]] static Expected<Set> read(const TlsFiles& files);

    const TlsFiles files_;
    const ReloadObserver observer_;
    std::mutex mutex_;
    WatchedFiles watched_;
    Set set_;
};

}  // namespace vsplit::guard
