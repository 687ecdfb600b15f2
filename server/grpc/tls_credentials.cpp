#include "grpc/tls_credentials.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>

namespace vsplit::rpc {

std::shared_ptr<grpc::ServerCredentials> credentials_of(const guard::TlsFiles& files) {
    namespace tls = grpc::experimental;
    if (files.cert.empty()) return grpc::InsecureServerCredentials();
    constexpr unsigned kLookEvery = 1;  // seconds
    tls::TlsServerCredentialsOptions options(
        std::make_shared<tls::FileWatcherCertificateProvider>(files.key, files.cert, files.client_ca, kLookEvery));
    options.watch_identity_key_cert_pairs();
    if (!files.client_ca.empty()) {
        options.watch_root_certs();
        options.set_cert_request_type(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
    }
    return tls::TlsServerCredentials(options);
}

}  // namespace vsplit::rpc
