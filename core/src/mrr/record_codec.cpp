#include "vsplit/mrr/record_codec.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "mrr/block_checks.h"
#include "mrr/block_coder.h"
#include "mrr/grid_codes.h"

namespace vsplit {
namespace {

constexpr std::size_t kHeaderBytes = 1;  // bits a coordinate, 0 for float32, and from kLayoutBit on the layout
constexpr unsigned kLayoutBit = 5;
static_assert(kMostBits < 1U << kLayoutBit);

/// What the columns of a record unpack to at most: a kind, a place, a fan and six coordinates, with all their bits.
constexpr std::size_t kMostUnpackedBytes = 64;

/// So many records make a block that most often is under the limit, but not by much.
std::size_t usual_records(RecordEncoding encoding) { return encoding == RecordEncoding::kFloat32 ? 16384 : 32768; }

}  // namespace

struct RecordCodec::Impl {
    PositionGrid grid;
    ColumnWriter writer;
    ColumnReader reader;

    template <class Codes>
    Status write(const RecordSpan& records, ProgressiveMesh& mesh);
    template <class Codes>
    Status read(const RecordBlock& block, BlockLayout layout, ProgressiveMesh& mesh, RecordList* records);
    [[nodiscard]] Status write_any(const RecordSpan& records, ProgressiveMesh& mesh) {
        return grid.encoding() == RecordEncoding::kFloat32 ? write<Float32Codes>(records, mesh)
                                                           : write<QuantisedCodes>(records, mesh);
    }
    [[nodiscard]] Expected<RecordBlock> encode_compact(const RecordList& records, std::size_t first, std::size_t count,
                                                       ProgressiveMesh& mesh);
    [[nodiscard]] Status decode_compact(const RecordBlock& block, ProgressiveMesh& mesh, RecordList* records);
};

RecordCodec::RecordCodec(const PositionGrid& grid) : impl_(std::make_unique<Impl>()) { impl_->grid = grid; }
RecordCodec::RecordCodec(RecordCodec&&) noexcept = default;
RecordCodec& RecordCodec::operator=(RecordCodec&&) noexcept = default;
RecordCodec::~RecordCodec() = default;

const PositionGrid& RecordCodec::grid() const { return impl_->grid; }

template <class Codes>
Status RecordCodec::Impl::write(const RecordSpan& records, ProgressiveMesh& mesh) {
    BlockCoder<SymbolWriter, Codes> coder(SymbolWriter(writer), Codes(grid), mesh, kNewestLayout);
    mesh.reserve(records.splits.size(), records.flips.size(), records.moves.size());
    coder.foresee(records.splits);
    bool coded = true;
    for_each_record(records, [&](auto record) { coded = coded && coder.code(record); });
    if (!coded) return coder.error();
    for (const RecordKind kind : records.kinds) writer.byte(column::kKinds, static_cast<std::uint8_t>(kind));
    return Done{};
}

Expected<RecordBlock> RecordCodec::Impl::encode_compact(const RecordList& records, std::size_t first, std::size_t count,
                                                        ProgressiveMesh& mesh) {
    const std::size_t before = mesh.records();
    for (;; count /= 2) {
        RecordBlock block{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), grid.encoding(), {}, 0};
        writer.clear();
        if (Status written = write_any(records.slice(first, count), mesh); !written) {
            mesh.rewind(before);
            return written.error();
        }
        block.payload.push_back(static_cast<char>(grid.bits() | static_cast<unsigned>(kNewestLayout) << kLayoutBit));
        writer.pack(block.payload);
        if (block.payload.size() <= kMaxBlockBytes) {
            block.crc32c = crc32c(std::as_bytes(std::span(block.payload)));
            return block;
        }
        mesh.rewind(before);
    }
}

template <class Codes>
Status RecordCodec::Impl::read(const RecordBlock& block, BlockLayout layout, ProgressiveMesh& mesh, RecordList* records) {
    const std::span<const std::uint8_t> kinds = reader.take(column::kKinds);
    if (kinds.size() != block.count) {
        return corrupt_block(
            block, "it has " + std::to_string(kinds.size()) + " kinds of records for a count of " + std::to_string(block.count));
    }
    BlockCoder<SymbolReader, Codes> coder(SymbolReader(reader), Codes(grid), mesh, layout);
    const auto take = [&](auto record) {
        if (!coder.code(record)) return false;
        if (records != nullptr) records->push_back(record);
        return true;
    };
    mesh.reserve(static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), 0)),
                 static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), 1)),
                 static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), 2)));
    coder.read_places(static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), 0)));
    for (std::size_t n = 0; n < kinds.size(); ++n) {
        const auto bad = [&](const std::string& what) {
            return corrupt_block(block, "record " + std::to_string(block.first + n) + ": " + what);
        };
        if (kinds[n] > 2) return bad("its kind is " + std::to_string(kinds[n]));
        const bool taken = kinds[n] == 0 ? take(VertexSplit()) : kinds[n] == 1 ? take(EdgeFlip()) : take(VertexMove());
        if (!taken) return bad(coder.error().message);
        if (reader.ran_short()) return bad("its columns are too short");
    }
    if (reader.all_read()) return Done{};
    return corrupt_block(block, "something is left over behind the last record");
}

Status RecordCodec::Impl::decode_compact(const RecordBlock& block, ProgressiveMesh& mesh, RecordList* records) {
    if (Status valid = check_block(block); !valid) return valid;
    if (block.count > kMaxBlockRecords) {
        return corrupt_block(block, std::to_string(block.count) + " records are more than the " +
                                        std::to_string(kMaxBlockRecords) + " a block may have");
    }
    const auto payload = std::as_bytes(std::span(block.payload));
    const unsigned header = payload.empty() ? 0xFFU : static_cast<unsigned>(payload[0]);
    if (header % (1U << kLayoutBit) != grid.bits())
        return corrupt_block(block, "it is not of " + std::to_string(grid.bits()) + " bits a coordinate, as the base mesh was");
    const auto layout = static_cast<BlockLayout>(header >> kLayoutBit);
    if (layout > kNewestLayout) {
        return corrupt_block(block, "its layout is " + std::to_string(header >> kLayoutBit) +
                                        "; this program reads layouts up to " +
                                        std::to_string(static_cast<unsigned>(kNewestLayout)));
    }
    if (Status unpacked = reader.unpack(payload.subspan(kHeaderBytes), block.count * kMostUnpackedBytes); !unpacked)
        return corrupt_block(block, unpacked.error().message);
    const std::size_t before = mesh.records();
    const std::size_t kept = records == nullptr ? 0 : records->size();
    Status done = grid.encoding() == RecordEncoding::kFloat32 ? read<Float32Codes>(block, layout, mesh, records)
                                                              : read<QuantisedCodes>(block, layout, mesh, records);
    if (done) return done;
    mesh.rewind(before);
    if (records != nullptr) records->truncate(kept);
    return done;
}

Expected<RecordBlock> RecordCodec::encode(const RecordList& records, std::size_t first, std::size_t last, ProgressiveMesh& mesh) {
    assert(first < last && last <= records.size());
    if (grid().encoding() != RecordEncoding::kFloat64)
        return impl_->encode_compact(records, first, std::min(last - first, usual_records(grid().encoding())), mesh);
    const std::size_t most = std::min(kMaxBlockBytes, last - first);  // no record takes less than a byte
    const RecordSpan fitting = records.slice(first, records_that_fit(records.slice(first, most), RecordEncoding::kFloat64));
    if (Status refined = mesh.refine(fitting); !refined) return refined.error();
    return encode_block(fitting, static_cast<std::uint32_t>(first), RecordEncoding::kFloat64);
}

Status RecordCodec::decode(const RecordBlock& block, ProgressiveMesh& mesh, RecordList* records) {
    if (block.encoding != grid().encoding()) {
        return corrupt_block(block, "its encoding is " + std::to_string(static_cast<std::uint32_t>(block.encoding)) +
                                        ", that of the base mesh was " +
                                        std::to_string(static_cast<std::uint32_t>(grid().encoding())));
    }
    if (block.encoding != RecordEncoding::kFloat64) return impl_->decode_compact(block, mesh, records);
    const Expected<RecordList> decoded = decode_block(block);
    if (!decoded) return decoded.error();
    const std::size_t before = mesh.records();
    if (Status refined = mesh.refine(*decoded); !refined) {
        mesh.rewind(before);
        return corrupt_block(block, refined.error().message);
    }
    if (records != nullptr) records->append(*decoded);
    return Done{};
}

}  // namespace vsplit
