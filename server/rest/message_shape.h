#pragma once

#include <google/protobuf/descriptor.h>

#include <optional>

namespace vsplit::rest {

/// Fields of a message that is a part of a stream of bytes: `bytes data` at `uint64 offset`; the others may be absent (null).
struct ChunkShape {
    const google::protobuf::FieldDescriptor* data = nullptr;
    const google::protobuf::FieldDescriptor* offset = nullptr;
    const google::protobuf::FieldDescriptor* size = nullptr;          ///< uint64: of the whole
    const google::protobuf::FieldDescriptor* file_name = nullptr;     ///< string
    const google::protobuf::FieldDescriptor* content_type = nullptr;  ///< string
    const google::protobuf::FieldDescriptor* digest = nullptr;        ///< string: of the whole, by which its bytes are known

    /// Empty for any other message.
    [[nodiscard]] static std::optional<ChunkShape> of(const google::protobuf::Descriptor& type);
};

/// What HTTP makes of an rpc.
enum class RpcShape {
    kUnary,   ///< JSON in, JSON out
    kEvents,  ///< JSON in, a stream of messages out
    kFile,    ///< JSON in, a file out: a stream of chunks
    kUpload,  ///< the body as it is in, as a stream of chunks; JSON out
    kNone,    ///< nothing HTTP could carry: both sides stream, or a stream of messages goes in
};

[[nodiscard]] RpcShape shape_of(const google::protobuf::MethodDescriptor& rpc);

/// Whether a message of this type has a field of bytes, which is no text for people: records, meshes.
[[nodiscard]] bool has_bytes(const google::protobuf::Descriptor& type);

/// The one oneof that the message is made of; null where there is another field beside it.
[[nodiscard]] const google::protobuf::OneofDescriptor* sole_oneof(const google::protobuf::Descriptor& type);

}  // namespace vsplit::rest
