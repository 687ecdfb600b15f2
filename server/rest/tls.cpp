#include "rest/tls.h"

#include <openssl/ssl.h>

#include <utility>

namespace vsplit::rest {
namespace {

using Context = std::shared_ptr<net::ssl::context>;

Error unusable(const std::string& file, const std::string& what, const ErrorCode& why) {
    return {Cause::kInvalidOption, "cannot use " + file + " as " + what + ": " + why.message() + "; accepted is PEM", "tls-cert"};
}

Expected<Context> make_context(const guard::TlsFiles& files) {
    using net::ssl::context;
    auto made = std::make_shared<context>(context::tls_server);
    SSL_CTX_set_min_proto_version(made->native_handle(), TLS1_2_VERSION);
    SSL_CTX_set_options(made->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
    ErrorCode failed;
    made->use_certificate_chain_file(files.cert, failed);
    if (failed) return unusable(files.cert, "a certificate", failed);
    made->use_private_key_file(files.key, context::pem, failed);
    if (failed) return unusable(files.key, "the certificate's key", failed);
    if (files.client_ca.empty()) return made;
    made->load_verify_file(files.client_ca, failed);
    if (failed) return unusable(files.client_ca, "authorities of clients", failed);
    made->set_verify_mode(net::ssl::verify_peer | net::ssl::verify_fail_if_no_peer_cert, failed);
    if (failed) return unusable(files.client_ca, "authorities of clients", failed);
    return made;
}

}  // namespace

TlsContexts::TlsContexts(guard::TlsFiles files, Context first, guard::ReloadObserver observer)
    : files_(std::move(files)),
      observer_(std::move(observer)),
      watched_({files_.cert, files_.key, files_.client_ca}),
      context_(std::move(first)) {}

Expected<std::shared_ptr<TlsContexts>> TlsContexts::open(const guard::TlsFiles& files, guard::ReloadObserver observer) {
    Expected<Context> first = make_context(files);
    if (!first) return first.error();
    return std::shared_ptr<TlsContexts>(new TlsContexts(files, *std::move(first), std::move(observer)));
}

Context TlsContexts::current() {
    const std::lock_guard lock(mutex_);
    if (!watched_.changed()) return context_;
    Expected<Context> made = make_context(files_);
    if (observer_) observer_(files_.cert, made ? Status(Done{}) : Status(made.error()));
    if (made) context_ = *std::move(made);
    return context_;
}

}  // namespace vsplit::rest
