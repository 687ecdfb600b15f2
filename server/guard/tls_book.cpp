#include "guard/tls_book.h"

#include <openssl/ssl.h>

#include <boost/asio/buffer.hpp>
#include <utility>

namespace vsplit::guard {
namespace {

using ErrorCode = boost::system::error_code;
using boost::asio::ssl::context;

constexpr std::size_t kMostBytes = std::size_t{1} << 20;

Error unusable(const std::string& file, const std::string& what, const ErrorCode& why) {
    return {Cause::kInvalidOption, "cannot use " + file + " as " + what + ": " + why.message() + "; accepted is PEM", "tls-cert"};
}

std::string names_of(const TlsFiles& files) {
    return files.cert + ", " + files.key + (files.client_ca.empty() ? "" : ", " + files.client_ca);
}

int authorities(context& tls) { return sk_X509_OBJECT_num(X509_STORE_get0_objects(SSL_CTX_get_cert_store(tls.native_handle()))); }

Expected<TlsSet> read_texts(const TlsFiles& files) {
    TlsSet set;
    for (const auto& [file, text] :
         {std::pair(&files.cert, &set.cert), {&files.key, &set.key}, {&files.client_ca, &set.client_ca}}) {
        if (file->empty()) continue;
        Expected<std::string> read = read_small_file(*file, kMostBytes);
        if (!read) return read.error();
        *text = *std::move(read);
    }
    return set;
}

}  // namespace

TlsBook::TlsBook(TlsFiles files, Set first, WatchedFiles watched, ReloadObserver observer)
    : files_(std::move(files)), observer_(std::move(observer)), watched_(std::move(watched)), set_(std::move(first)) {}

Expected<TlsBook::Set> TlsBook::read(const TlsFiles& files) {
    Expected<TlsSet> texts = read_texts(files);
    if (!texts) return texts.error();
    TlsSet set = *std::move(texts);
    set.context = std::make_shared<context>(context::tls_server);
    SSL_CTX_set_min_proto_version(set.context->native_handle(), TLS1_2_VERSION);
    SSL_CTX_set_options(set.context->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
    ErrorCode failed;
    set.context->use_certificate_chain(boost::asio::buffer(set.cert), failed);
    if (failed) return unusable(files.cert, "a certificate", failed);
    set.context->use_private_key(boost::asio::buffer(set.key), context::pem, failed);
    if (failed) return unusable(files.key, "the certificate's key", failed);
    if (!files.client_ca.empty()) {
        set.context->add_certificate_authority(boost::asio::buffer(set.client_ca), failed);
        if (!failed && authorities(*set.context) == 0)
            return Error{Cause::kInvalidOption, files.client_ca + " has no certificate of an authority; accepted is PEM",
                         "tls-client-ca"};
        if (!failed)
            set.context->set_verify_mode(boost::asio::ssl::verify_peer | boost::asio::ssl::verify_fail_if_no_peer_cert, failed);
        if (failed) return unusable(files.client_ca, "authorities of clients", failed);
    }
    return Set(std::make_shared<const TlsSet>(std::move(set)));
}

Expected<std::shared_ptr<TlsBook>> TlsBook::open(const TlsFiles& files, ReloadObserver observer) {
    WatchedFiles watched({files.cert, files.key, files.client_ca});  // before they are read: a change meanwhile is seen later
    Expected<Set> first = read(files);
    if (!first) return first.error();
    return std::shared_ptr<TlsBook>(new TlsBook(files, *std::move(first), std::move(watched), std::move(observer)));
}

std::shared_ptr<const TlsSet> TlsBook::current() {
    const std::lock_guard lock(mutex_);
    if (!watched_.changed()) return set_;
    Expected<Set> set = read(files_);
    const Status read_anew = set ? Status(Done{}) : Status(set.error());
    if (watched_.note(read_anew) && observer_) observer_(names_of(files_), read_anew);
    if (set) set_ = *std::move(set);
    return set_;
}

}  // namespace vsplit::guard
