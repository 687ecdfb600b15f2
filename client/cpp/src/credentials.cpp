#include "credentials.h"

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace vsplit::client {
namespace {

using grpc::experimental::InterceptionHookPoints;

class Marker final : public grpc::experimental::Interceptor {
public:
    Marker(const std::string& token, const std::string& traceparent) : token_(token), traceparent_(traceparent) {}

    void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
        if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_INITIAL_METADATA)) {
            auto& metadata = *methods->GetSendInitialMetadata();
            if (!token_.empty()) metadata.insert({"authorization", "Bearer " + token_});
            if (!traceparent_.empty()) metadata.insert({"traceparent", traceparent_});
        }
        methods->Proceed();
    }

private:
    const std::string& token_;
    const std::string& traceparent_;
};

// Lives as long as the channel, and its calls not longer.
class MarkerFactory final : public grpc::experimental::ClientInterceptorFactoryInterface {
public:
    explicit MarkerFactory(const ConnectOptions& options) : token_(options.token), traceparent_(options.traceparent) {}

    grpc::experimental::Interceptor* CreateClientInterceptor(grpc::experimental::ClientRpcInfo* /*info*/) override {
        return new Marker(token_, traceparent_);
    }

private:
    const std::string token_;
    const std::string traceparent_;
};

Expected<std::string> read_pem(const std::string& file, const char* field) {
    if (file.empty()) return std::string();
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in || text.empty()) return Error{Cause::kFileAccess, "cannot read '" + file + "'; accepted is a file of PEM", field};
    return text;
}

}  // namespace

Expected<std::shared_ptr<grpc::ChannelCredentials>> channel_credentials(const ConnectOptions& options) {
    const TlsOptions& tls = options.tls;
    if (tls.cert.empty() != tls.key.empty() || (!tls.cert.empty() && tls.ca.empty()))
        return Error{Cause::kInvalidOption, "a client's certificate takes its key and the server's authorities too", "tls_cert"};
    if (tls.ca.empty()) return grpc::InsecureChannelCredentials();
    const bool system = tls.ca == kSystemAuthorities;
    Expected<std::string> ca = system ? Expected<std::string>(std::string()) : read_pem(tls.ca, "tls_ca");
    if (!ca) return ca.error();
    Expected<std::string> cert = read_pem(tls.cert, "tls_cert");
    if (!cert) return cert.error();
    Expected<std::string> key = read_pem(tls.key, "tls_key");
    if (!key) return key.error();
    return grpc::SslCredentials({*std::move(ca), *std::move(key), *std::move(cert)});
}

InterceptorFactories call_marks(const ConnectOptions& options) {
    InterceptorFactories factories;
    if (!options.token.empty() || !options.traceparent.empty()) factories.push_back(std::make_unique<MarkerFactory>(options));
    return factories;
}

}  // namespace vsplit::client
