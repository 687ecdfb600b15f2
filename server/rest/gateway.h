#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <vector>

#include "guard/gatekeeper.h"
#include "rest/exchange.h"
#include "rest/handlers.h"
#include "rest/pages.h"
#include "rest/rest_options.h"
#include "rest/router.h"
#include "rest/schema.h"
#include "rest/turns.h"

namespace vsplit::rest {

/// What REST stands in front of.
struct Backend {
    std::shared_ptr<grpc::Channel> channel;           ///< to the server with the rpcs
    std::vector<std::string_view> descriptor_sets{};  ///< of its services, with source info; they must live as long
    std::vector<std::string> services{};              ///< full names
    std::function<bool()> ready{};                    ///< whether new work is taken; empty: always
    std::function<Status(const Exchange&)> admit{};   ///< who may see a guarded page; empty: everybody
    std::function<Status(const Exchange&)> pace{};    ///< whether a client may ask for what is no rpc so soon; empty: it may
    std::function<std::string()> metrics{};           ///< text for /metrics; empty: no such page
    Pages pages{};                                    ///< more of them, or others in their place
    std::string version{};                            ///< of the server, for the OpenAPI document
};

/// What lets those in whose token at least reads. `gate` must outlive it.
[[nodiscard]] std::function<Status(const Exchange&)> admission_of(guard::Gatekeeper& gate);

/// What counts a request of its client, whoever it is, and refuses those that come too fast. `gate` must outlive it.
[[nodiscard]] std::function<Status(const Exchange&)> pace_of(guard::Gatekeeper& gate);

/// Decides what answers a request. Thread-safe but for its set-up.
class Gateway {
public:
    /// \return MALFORMED_INPUT, NOT_FOUND for descriptors that do not fit.
    [[nodiscard]] static Expected<std::unique_ptr<Gateway>> make(Backend backend, RestOptions options);
    ~Gateway();

    [[nodiscard]] const RestLimits& limits() const { return options_.limits; }
    [[nodiscard]] const RestOptions& options() const { return options_; }

    /// How the answer to this request is written.
    [[nodiscard]] ResponseManner manner_of(const http::request<http::buffer_body>& request);

    /// Answers it, whatever it is. Throws bad_alloc only.
    Awaitable<void> serve(Exchange& exchange);

private:
    Gateway(Backend backend, RestOptions options, std::unique_ptr<Schema> schema, Router router);

    Awaitable<bool> in_time(Exchange& exchange) const;
    Awaitable<void> refuse(Exchange& exchange, const Problem& problem);
    Awaitable<void> serve_target(Exchange& exchange, const Target& target);
    Awaitable<void> serve_options(Exchange& exchange, const std::string& allowed);
    Awaitable<void> serve_page(Exchange& exchange, const Page& page);
    Awaitable<void> serve_ready(Exchange& exchange);
    Awaitable<void> serve_rpc(Exchange& exchange, const Route& route, const Target& target);

    Backend backend_;
    const RestOptions options_;
    const std::unique_ptr<Schema> schema_;
    const Router router_;
    Pages pages_;
    JsonBudget budget_;
    Background background_;
    Turns files_;
    RpcClient rpcs_;
};

}  // namespace vsplit::rest
