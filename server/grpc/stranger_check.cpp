#include "grpc/stranger_check.h"

#include <utility>

#include "grpc/method_name.h"
#include "wire/error_table.h"

namespace vsplit::rpc {

StrangerCheck::StrangerCheck(const LiveCalls& live, RpcObserver observer, guard::Gatekeeper* gate, RpcMeter* meter)
    : live_(live), observer_(std::move(observer)), gate_(gate), meter_(meter) {}

grpc::Status StrangerCheck::look(const grpc_auth_context* connection, const HeaderLookup& header) const {
    const Status decided = decide(connection, header);
    if (decided) return {};
    grpc::Status refused = wire::to_status(decided.error());
    tell(header, refused);
    return refused;
}

Status StrangerCheck::decide(const grpc_auth_context* connection, const HeaderLookup& header) const {
    const MethodName::Kind kind = method_name(header(":path")).kind;
    if (gate_ != nullptr && kind == MethodName::Kind::kContract) {
        if (Status known = gate_->recognise(header("authorization")); !known) return known;
    }
    return live_.admit(connection, kind);
}

void StrangerCheck::tell(const HeaderLookup& header, const grpc::Status& refused) const {
    const MethodName method = method_name(header(":path"));
    if (meter_ != nullptr) {
        meter_->rpc_began(method.text);
        meter_->rpc_ended(method.text, refused.error_code(), {});
    }
    if (method.kind == MethodName::Kind::kContract && observer_) {
        RpcRecord record{method.text, "", refused};
        record.origin = origin_of(header, "");
        record.origin.authorization.clear();
        observer_(record);
    }
}

}  // namespace vsplit::rpc
