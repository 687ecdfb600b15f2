#include "wire/json_check.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wire/enum_value.h"
#include "wire/field.h"
#include "wire/json_respelling.h"
#include "wire/json_value.h"
#include "wire/utf8.h"

namespace vsplit::wire {
namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;

namespace {

// Deeper than any message of a contract; protobuf's own limit is 100.
constexpr std::size_t kDeepest = 64;
constexpr std::size_t kQuotedBytes = 100;

// Times and durations are texts, structs and the like anything: what fits them, protobuf knows.
bool is_protobufs_own(const Field& field) {
    return field.cpp_type() == Field::CPPTYPE_MESSAGE && field.message_type()->file()->package() == "google.protobuf";
}

// Follows a text as nlohmann's parser reads it. Returning false ends that; `error` says why.
class Reader {
public:
    Reader(std::string_view text, const pb::Descriptor& type, UnknownFields unknown, Respelling* respelling = nullptr)
        : text_(text), root_(type), unknown_(unknown), respelling_(respelling) {}

    [[nodiscard]] Expected<JsonSize> result() && {
        if (error_) return *std::move(error_);
        return size_;
    }

    // The names are those that nlohmann's parser calls.

    bool null() { return scalar(nullptr); }
    bool boolean(bool value) { return scalar(value); }
    bool number_integer(std::int64_t value) { return scalar(value); }
    bool number_unsigned(std::uint64_t value) { return scalar(value); }
    bool number_float(double value, const std::string& /*as written*/) { return scalar(value); }
    bool string(std::string& value) { return scalar(std::move(value)); }
    bool binary(nlohmann::json::binary_t& /*never in JSON*/) { return false; }

    bool start_object(std::size_t /*unknown*/) {
        ++size_.messages;
        begin_value();
        if (frames_.empty()) return push({Kind::kObject, &root_, nullptr});
        if (takes_anything()) return push({Kind::kAnything, nullptr, nullptr});
        const Field& field = *frames_.back().field;
        if (field.cpp_type() != Field::CPPTYPE_MESSAGE || !is_place_of_one(field)) return misfit("an object");
        return push({Kind::kObject, field.message_type(), nullptr});
    }

    bool key(std::string& name) {
        Frame& frame = frames_.back();
        if (frame.kind == Kind::kAnything) return true;
        frame.field = find_field(*frame.type, name);
        if (frame.field == nullptr) {
            if (unknown_ == UnknownFields::kIgnored) return true;
            const std::string above = path();
            return refuse(unknown_field(above + (above.empty() ? "" : ".") + name, *frame.type));
        }
        return note(*frame.field);
    }

    bool end_object() { return pop(); }

    bool start_array(std::size_t /*unknown*/) {
        ++size_.values;
        begin_value();
        if (frames_.empty()) return refuse(no_object("a list"));
        if (takes_anything()) return push({Kind::kAnything, nullptr, nullptr});
        const Field& field = *frames_.back().field;
        if (is_place_of_one(field)) return misfit("a list");
        return push({Kind::kList, nullptr, &field});
    }

    bool end_array() { return pop(); }

    bool parse_error(std::size_t at, const std::string& token, const nlohmann::json::exception& why) {
        constexpr int kNumberTooLarge = 406;
        if (why.id == kNumberTooLarge && !frames_.empty()) {
            begin_value();
            return refuse(bad_value(path(), token, "a number up to 1.8e308"));
        }
        const std::string where = path();
        const std::string within = where.empty() ? "" : ", in " + valid_utf8(where, kQuotedBytes);
        const std::size_t byte = std::min(at, text_.size());
        std::string what = "not the JSON of a " + root_.full_name() + ": ";
        if (at > text_.size() || text_.find_first_not_of(" \t\r\n") == std::string_view::npos) {
            what += "it ends after byte " + std::to_string(text_.size()) + within + ", where more is due";
        } else {
            what += "at byte " + std::to_string(byte) + within + " it breaks off with \"" + valid_utf8(token, kQuotedBytes) + '"';
        }
        return refuse({Cause::kMalformedInput, what + "; accepted is JSON as RFC 8259 has it, in UTF-8", ""});
    }

private:
    enum class Kind { kObject, kList, kAnything };

    // An object or a list that has begun.
    struct Frame {
        Kind kind;
        const pb::Descriptor* type;  // of an object
        const Field* field;          // of a list, or the one that an object is at; null for one that is ignored
        std::size_t begun = 0;       // elements of a list
        std::size_t first_seen = 0;  // of an object: where its fields begin in seen_
    };

    bool refuse(Error error) {
        error_ = std::move(error);
        return false;
    }

    bool push(const Frame& frame) {
        if (frames_.size() == kDeepest) {
            return refuse({Cause::kMalformedInput,
                           "not the JSON of a " + root_.full_name() + ": it is nested deeper than " + std::to_string(kDeepest) +
                               " objects and lists, in " + valid_utf8(path(), kQuotedBytes),
                           ""});
        }
        frames_.push_back(frame);
        frames_.back().first_seen = seen_.size();
        return true;
    }

    bool pop() {
        seen_.resize(frames_.back().first_seen);
        frames_.pop_back();
        return true;
    }

    void begin_value() {
        if (!frames_.empty() && frames_.back().kind == Kind::kList) ++frames_.back().begun;
    }

    // Whether nobody but protobuf, or nobody at all, looks at the value that begins.
    [[nodiscard]] bool takes_anything() const {
        const Frame& frame = frames_.back();
        return frame.kind == Kind::kAnything || frame.field == nullptr || frame.field->is_map() || is_protobufs_own(*frame.field);
    }

    // Whether one value belongs where the reader is, not a list.
    [[nodiscard]] bool is_place_of_one(const Field& field) const {
        return frames_.back().kind == Kind::kList || !field.is_repeated();
    }

    bool misfit(std::string_view value) {
        const Field& field = *frames_.back().field;
        return refuse(bad_value(path(), value, (is_place_of_one(field) ? "" : "a list, each element ") + accepted_values(field)));
    }

    bool scalar(const JsonScalar& value) {
        ++size_.values;
        begin_value();
        if (frames_.empty()) return refuse(no_object(text_of(value)));
        if (takes_anything() || std::holds_alternative<std::nullptr_t>(value)) return true;  // null: as if it were not there
        const Field& field = *frames_.back().field;
        if (!is_place_of_one(field) || !takes_value(field, value)) return misfit(text_of(value));
        if (field.cpp_type() == Field::CPPTYPE_ENUM) respell(*field.enum_type(), std::get_if<std::string>(&value));
        return true;
    }

    // Protobuf takes one name only; a number in a text is no name at all.
    void respell(const pb::EnumDescriptor& type, const std::string* name) {
        const pb::EnumValueDescriptor* const called = name == nullptr ? nullptr : find_value(type, *name);
        if (called == nullptr || called->name() == *name) return;
        size_.respelled = true;
        if (respelling_ != nullptr) respelling_->replace_last(called->name());
    }

    [[nodiscard]] Error no_object(const std::string& what) const {
        std::string fields;
        for (int i = 0; i < root_.field_count(); ++i) fields += (i == 0 ? " with " : ", ") + root_.field(i)->json_name();
        return {Cause::kMalformedInput,
                "not the JSON of a " + root_.full_name() + ": it is " + valid_utf8(what, kQuotedBytes) +
                    "; accepted is an object" + fields,
                ""};
    }

    // That a field is there, once, and without one that it excludes.
    bool note(const Field& field) {
        const pb::OneofDescriptor* const oneof = field.real_containing_oneof();
        for (std::size_t i = frames_.back().first_seen; i < seen_.size(); ++i) {
            if (seen_[i] == &field) return refuse({Cause::kInvalidOption, path() + " is there twice; accepted is once", path()});
            if (oneof == nullptr || seen_[i]->real_containing_oneof() != oneof) continue;
            return refuse({Cause::kInvalidOption,
                           path() + " and " + seen_[i]->json_name() + " exclude each other; accepted is one of them", path()});
        }
        seen_.push_back(&field);
        return true;
    }

    // Where the text is being read: "options.sizing.boxes[3].min".
    [[nodiscard]] std::string path() const {
        std::string text;
        for (const Frame& frame : frames_) {
            if (frame.kind == Kind::kList && frame.begun > 0) text += '[' + std::to_string(frame.begun - 1) + ']';
            if (frame.kind == Kind::kObject && frame.field != nullptr)
                text += (text.empty() ? "" : ".") + frame.field->json_name();
        }
        return text;
    }

    const std::string_view text_;
    const pb::Descriptor& root_;
    const UnknownFields unknown_;
    Respelling* const respelling_;
    JsonSize size_;
    std::vector<Frame> frames_;
    std::vector<const Field*> seen_;
    std::optional<Error> error_;
};

}  // namespace

Expected<JsonSize> check_json(std::string_view text, const pb::Descriptor& type, UnknownFields unknown) {
    Reader reader(text, type, unknown);
    static_cast<void>(nlohmann::json::sax_parse(text.begin(), text.end(), &reader));
    return std::move(reader).result();
}

std::string respell_json(std::string_view text, const pb::Descriptor& type) {
    Respelling respelling(text);
    Reader reader(text, type, UnknownFields::kIgnored, &respelling);
    static_cast<void>(nlohmann::json::sax_parse(respelling.begin(), respelling.end(), &reader));
    return std::move(respelling).made();
}

}  // namespace vsplit::wire
