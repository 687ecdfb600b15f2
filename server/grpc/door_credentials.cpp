#include "grpc/door_credentials.h"

#include <grpc/grpc.h>
#include <grpc/grpc_security.h>

#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace vsplit::rpc {
namespace {

/// Gives gRPC a certificate for each new connection: a new one where the book has one. Files are read and judged by the book
/// alone: gRPC's own watcher would take any, and then serve nobody.
class CertificateSource {
public:
    explicit CertificateSource(std::shared_ptr<guard::TlsBook> book) : book_(std::move(book)) {}

    [[nodiscard]] bool wants_client_certificate() { return !book_->current()->client_ca.empty(); }

    static grpc_ssl_certificate_config_reload_status fetch(void* self, grpc_ssl_server_certificate_config** config) {
        return static_cast<CertificateSource*>(self)->give(*config);
    }

private:
    grpc_ssl_certificate_config_reload_status give(grpc_ssl_server_certificate_config*& config) {
        const std::lock_guard lock(mutex_);
        std::shared_ptr<const guard::TlsSet> now = book_->current();
        if (now == given_) return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_UNCHANGED;
        given_ = std::move(now);
        const grpc_ssl_pem_key_cert_pair pair{given_->key.c_str(), given_->cert.c_str()};
        // gRPC insists on some authorities; where clients are asked for no certificate it does not use them.
        const std::string& authorities = given_->client_ca.empty() ? given_->cert : given_->client_ca;
        config = grpc_ssl_server_certificate_config_create(authorities.c_str(), &pair, 1);
        return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_NEW;
    }

    const std::shared_ptr<guard::TlsBook> book_;
    std::mutex mutex_;
    std::shared_ptr<const guard::TlsSet> given_;
};

std::string_view text_of(const grpc_slice& slice) {
    return {reinterpret_cast<const char*>(GRPC_SLICE_START_PTR(slice)), GRPC_SLICE_LENGTH(slice)};
}

void look_at_header(void* check, grpc_auth_context* connection, const grpc_metadata* header, std::size_t size,
                    grpc_process_auth_metadata_done_cb done, void* call) {
    const auto find = [header, size](std::string_view name) -> std::string_view {
        for (std::size_t i = 0; i < size; ++i) {
            if (text_of(header[i].key) == name) return text_of(header[i].value);
        }
        return {};
    };
    const grpc::Status known = static_cast<StrangerCheck*>(check)->look(connection, find);
    done(call, nullptr, 0, nullptr, 0, static_cast<grpc_status_code>(known.error_code()),
         known.ok() ? nullptr : known.error_message().c_str());
}

/// Credentials of the C library, which has what the C++ one leaves out: certificates that are asked for, and calls that are
/// looked at over plain connections too.
class DoorCredentials final : public grpc::ServerCredentials {
public:
    DoorCredentials(std::shared_ptr<guard::TlsBook> tls, StrangerCheck* check) {
        if (tls == nullptr) {
            credentials_ = grpc_insecure_server_credentials_create();
        } else {
            source_.emplace(std::move(tls));
            credentials_ =
                grpc_ssl_server_credentials_create_with_options(grpc_ssl_server_credentials_create_options_using_config_fetcher(
                    source_->wants_client_certificate() ? GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY
                                                        : GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE,
                    &CertificateSource::fetch, &*source_));
        }
        if (check != nullptr)
            grpc_server_credentials_set_auth_metadata_processor(credentials_, {&look_at_header, nullptr, check});
    }

    ~DoorCredentials() override { grpc_server_credentials_release(credentials_); }
    DoorCredentials(const DoorCredentials&) = delete;
    DoorCredentials& operator=(const DoorCredentials&) = delete;

    void SetAuthMetadataProcessor(const std::shared_ptr<grpc::AuthMetadataProcessor>& /*none*/) override {}

private:
    int AddPortToServer(const std::string& address, grpc_server* server) override {
        return grpc_server_add_http2_port(server, address.c_str(), credentials_);
    }

    std::optional<CertificateSource> source_;
    grpc_server_credentials* credentials_ = nullptr;
};

}  // namespace

std::shared_ptr<grpc::ServerCredentials> door_credentials(std::shared_ptr<guard::TlsBook> tls, StrangerCheck* check) {
    return std::make_shared<DoorCredentials>(std::move(tls), check);
}

}  // namespace vsplit::rpc
