#include "text.h"

#include <ft2build.h>

#include <utility>
#include FT_FREETYPE_H

namespace vsplit::render {

struct Typeface::Face {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    Face() = default;
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;
    ~Face() {
        if (face != nullptr) FT_Done_Face(face);
        if (library != nullptr) FT_Done_FreeType(library);
    }
};

namespace {

void blend_glyph(Picture& picture, const FT_Bitmap& bitmap, int left, int top, Colour colour) {
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
        for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
            const unsigned char cover = bitmap.buffer[row * bitmap.pitch + column];
            if (cover > 0) picture.blend(left + column, top + row, colour, cover / 255.0);
        }
    }
}

/// Calls `visit(slot, pen)` for each glyph and returns where the pen ends; both in 1/64 pixels from the start.
template <class Visit>
FT_Pos walk(FT_Face face, int size, std::string_view text, const Visit& visit) {
    FT_Pos pen = 0;
    if (FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size)) != 0) return pen;
    for (const char letter : text) {
        const FT_ULong code = letter > 0 ? static_cast<FT_ULong>(letter) : FT_ULong{'?'};
        if (FT_Load_Char(face, code, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) continue;
        visit(*face->glyph, pen);
        pen += face->glyph->advance.x;
    }
    return pen;
}

int to_pixels(FT_Pos position) { return static_cast<int>((position + 32) / 64); }

}  // namespace

Typeface::Typeface(std::unique_ptr<Face> face) : face_(std::move(face)) {}
Typeface::Typeface(Typeface&&) noexcept = default;
Typeface& Typeface::operator=(Typeface&&) noexcept = default;
Typeface::~Typeface() = default;

Expected<Typeface> Typeface::open(const std::filesystem::path& path) {
    auto face = std::make_unique<Face>();
    if (FT_Init_FreeType(&face->library) != 0) return Error{Cause::kInternal, "FreeType cannot be started", ""};
    if (FT_New_Face(face->library, path.c_str(), 0, &face->face) != 0) {
        return Error{Cause::kFileAccess, path.string() + ": not a typeface that can be opened (Debian: fonts-dejavu-core)",
                     "font"};
    }
    return Typeface(std::move(face));
}

int Typeface::draw(Picture& picture, int x, int y, int size, Colour colour, std::string_view text) const {
    return to_pixels(walk(face_->face, size, text, [&](const FT_GlyphSlotRec& slot, FT_Pos pen) {
        blend_glyph(picture, slot.bitmap, x + to_pixels(pen) + slot.bitmap_left, y - slot.bitmap_top, colour);
    }));
}

int Typeface::width(int size, std::string_view text) const {
    return to_pixels(walk(face_->face, size, text, [](const FT_GlyphSlotRec&, FT_Pos) {}));
}

}  // namespace vsplit::render
