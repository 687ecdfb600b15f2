#include "rest/message_shape.h"

namespace vsplit::rest {
namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;

namespace {

const Field* find(const pb::Descriptor& type, const char* name, Field::Type kind) {
    const Field* const field = type.FindFieldByName(name);
    return field != nullptr && field->type() == kind && !field->is_repeated() ? field : nullptr;
}

}  // namespace

std::optional<ChunkShape> ChunkShape::of(const pb::Descriptor& type) {
    const ChunkShape shape{find(type, "data", Field::TYPE_BYTES),          find(type, "offset", Field::TYPE_UINT64),
                           find(type, "size", Field::TYPE_UINT64),         find(type, "file_name", Field::TYPE_STRING),
                           find(type, "content_type", Field::TYPE_STRING), find(type, "digest", Field::TYPE_STRING)};
    if (shape.data == nullptr || shape.offset == nullptr) return std::nullopt;
    return shape;
}

RpcShape shape_of(const pb::MethodDescriptor& rpc) {
    if (rpc.client_streaming()) {
        const bool upload = !rpc.server_streaming() && ChunkShape::of(*rpc.input_type());
        return upload ? RpcShape::kUpload : RpcShape::kNone;
    }
    if (!rpc.server_streaming()) return RpcShape::kUnary;
    return ChunkShape::of(*rpc.output_type()) ? RpcShape::kFile : RpcShape::kEvents;
}

bool has_bytes(const pb::Descriptor& type) {
    for (int i = 0; i < type.field_count(); ++i) {
        if (type.field(i)->type() == Field::TYPE_BYTES) return true;
    }
    return false;
}

const pb::OneofDescriptor* sole_oneof(const pb::Descriptor& type) {
    if (type.real_oneof_decl_count() != 1) return nullptr;
    const pb::OneofDescriptor* const oneof = type.oneof_decl(0);
    return oneof->field_count() == type.field_count() ? oneof : nullptr;
}

}  // namespace vsplit::rest
