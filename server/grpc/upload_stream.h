#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "grpc/rpc_ledger.h"
#include "service/meshing_service.h"
#include "service/patience.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::rpc {

/// UploadMesh: one part at a time goes from the network to the disk; the next is read when it is there, so an upload of any size
/// takes one part of memory. Reading the mesh is an errand. A client that tries `patience` is not waited for. Deletes itself.
class UploadStream final : public grpc::ServerReadReactor<v1::UploadMeshRequest> {
public:
    UploadStream(service::MeshingService& service, RpcWatch watch, v1::Session* response, const service::Patience& patience);

    void OnReadDone(bool ok) override;
    void OnSendInitialMetadataDone(bool ok) override;
    void OnCancel() override { cancelled_ = true; }
    void OnDone() override { delete this; }

private:
    [[nodiscard]] Status take_part();
    [[nodiscard]] Status begin();
    [[nodiscard]] Status check_repeated() const;
    [[nodiscard]] Status commit();
    void read();
    void read_on();
    [[nodiscard]] Error stalled() const;
    void finish_upload();
    void end(const Status& status);

    service::MeshingService& service_;
    RpcWatch watch_;
    v1::Session* const response_;
    v1::UploadMeshRequest part_;
    v1::UploadMeshRequest first_;  // without its data
    std::optional<service::Upload> upload_;
    std::atomic<bool> cancelled_{false};
    const service::Patience patience_;
    const service::Patience::Time start_ = std::chrono::steady_clock::now();
    std::uint64_t received_ = 0;  // bytes
    std::optional<grpc::Alarm> alarm_;
    std::shared_ptr<std::atomic<bool>> reading_;  // whoever clears it, the read or its alarm, goes on
};

}  // namespace vsplit::rpc
