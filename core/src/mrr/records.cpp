#include "vsplit/mrr/records.h"

#include <algorithm>
#include <cassert>

namespace vsplit {
namespace {

constexpr std::size_t kMarkEvery = 256;

}  // namespace

bool RecordSpan::consistent() const {
    std::size_t count_of[3] = {0, 0, 0};
    for (const RecordKind kind : kinds) {
        if (kind > RecordKind::kMove) return false;
        ++count_of[static_cast<std::size_t>(kind)];
    }
    return count_of[0] == splits.size() && count_of[1] == flips.size() && count_of[2] == moves.size();
}

void RecordList::Counts::add(RecordKind kind) {
    splits += kind == RecordKind::kSplit ? 1 : 0;
    flips += kind == RecordKind::kFlip ? 1 : 0;
    moves += kind == RecordKind::kMove ? 1 : 0;
}

RecordList::RecordList(std::initializer_list<Record> records) {
    for (const Record& record : records) push_back(record);
}

void RecordList::push_kind(RecordKind kind) {
    if (kinds_.size() % kMarkEvery == 0) marks_.push_back(all_);
    kinds_.push_back(kind);
    all_.add(kind);
}

void RecordList::push_back(const VertexSplit& split) {
    push_kind(RecordKind::kSplit);
    splits_.push_back(split);
}

void RecordList::push_back(EdgeFlip flip) {
    push_kind(RecordKind::kFlip);
    flips_.push_back(flip);
}

void RecordList::push_back(const VertexMove& move) {
    push_kind(RecordKind::kMove);
    moves_.push_back(move);
}

void RecordList::push_back(const Record& record) {
    std::visit([this](const auto& kind) { push_back(kind); }, record);
}

void RecordList::append(const RecordSpan& records) {
    assert(records.consistent());
    for (const RecordKind kind : records.kinds) push_kind(kind);
    splits_.insert(splits_.end(), records.splits.begin(), records.splits.end());
    flips_.insert(flips_.end(), records.flips.begin(), records.flips.end());
    moves_.insert(moves_.end(), records.moves.begin(), records.moves.end());
}

void RecordList::reserve(std::size_t splits, std::size_t flips, std::size_t moves) {
    kinds_.reserve(splits + flips + moves);
    splits_.reserve(splits);
    flips_.reserve(flips);
    moves_.reserve(moves);
    marks_.reserve((splits + flips + moves) / kMarkEvery + 1);
}

void RecordList::clear() { *this = {}; }

void RecordList::truncate(std::size_t records) {
    assert(records <= size());
    all_ = before(records);
    kinds_.resize(records);
    splits_.resize(all_.splits);
    flips_.resize(all_.flips);
    moves_.resize(all_.moves);
    marks_.resize((records + kMarkEvery - 1) / kMarkEvery);
}

RecordList::Counts RecordList::before(std::size_t record) const {
    if (record == size()) return all_;
    const std::size_t mark = record / kMarkEvery;
    Counts counts = marks_[mark];
    for (std::size_t n = mark * kMarkEvery; n < record; ++n) counts.add(kinds_[n]);
    return counts;
}

RecordSpan RecordList::slice(std::size_t first, std::size_t count) const {
    assert(first <= size() && count <= size() - first);
    const Counts from = before(first);
    const Counts to = before(first + count);
    return {kinds().subspan(first, count), splits().subspan(from.splits, to.splits - from.splits),
            flips().subspan(from.flips, to.flips - from.flips), moves().subspan(from.moves, to.moves - from.moves)};
}

Record RecordList::operator[](std::size_t number) const {
    const RecordSpan one = slice(number, 1);
    if (!one.splits.empty()) return one.splits[0];
    if (!one.flips.empty()) return one.flips[0];
    return one.moves[0];
}

std::size_t RecordList::record_of_split(std::size_t split) const {
    assert(split < splits_.size());
    // The last mark that has at most `split` splits before it; the split comes before the next mark.
    const auto after = std::upper_bound(marks_.begin(), marks_.end(), split,
                                        [](std::size_t number, const Counts& mark) { return number < mark.splits; });
    std::size_t left = split - (after - 1)->splits;
    std::size_t record = static_cast<std::size_t>(after - 1 - marks_.begin()) * kMarkEvery;
    for (;; ++record) {
        if (kinds_[record] == RecordKind::kSplit && left-- == 0) return record;
    }
}

}  // namespace vsplit
