// 3MF: what is written comes back, what others write is read as it is meant, and what is wrong is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "io/zip_reader.h"
#include "io/zip_writer.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;
using Members = std::map<std::string, std::vector<std::uint32_t>>;
using Files = std::vector<std::pair<std::string, std::string>>;

std::string archive_of(const Files& files) {
    ZipWriter writer;
    for (const auto& [name, text] : files) {
        writer.begin(name);
        writer.add(text);
    }
    return writer.take();
}

constexpr const char* kCore = "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"";
constexpr const char* kTetrahedron =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" "
    "v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"2\" v2=\"0\" v3=\"3\"/></triangles></mesh>";

std::string object(int id, const std::string& attributes, const std::string& content = kTetrahedron) {
    return "<object id=\"" + std::to_string(id) + "\" " + attributes + ">" + content + "</object>\n";
}

std::string components(int id, int times) {
    std::string text = "<components>";
    for (int i = 0; i < times; ++i) text.append("<component objectid=\"").append(std::to_string(id)).append("\"/>");
    return text.append("</components>");
}

std::string model(const std::string& objects, const std::string& items, const std::string& attributes = "") {
    return std::string("<?xml version=\"1.0\"?>\n<model ") + kCore + " " + attributes + ">\n<resources>\n" + objects +
           "</resources>\n<build>\n" + items + "</build>\n</model>\n";
}

std::string file(const std::string& objects, const std::string& items, const std::string& attributes = "") {
    return archive_of({{"3D/3dmodel.model", model(objects, items, attributes)}});
}

Expected<ReadResult> read(const std::string& bytes, const ReadOptions& options = {}) {
    return read_mesh(std::as_bytes(std::span(bytes)), options);
}

ReadResult must_read(const std::string& bytes, const ReadOptions& options = {}) {
    Expected<ReadResult> result = read(bytes, options);
    EXPECT_TRUE(result) << result.error().message;
    return result ? *std::move(result) : ReadResult();
}

Error error_of(const std::string& bytes, const ReadOptions& options = {}) {
    const Expected<ReadResult> result = read(bytes, options);
    EXPECT_FALSE(result);
    return result ? Error{} : result.error();
}

/// The XML in an archive that was written.
std::string model_text(const std::string& archive) {
    const Expected<ZipReader> reader = ZipReader::open(std::as_bytes(std::span(archive)));
    Expected<ZipStream> stream = reader->unpack(*reader->find("3D/3dmodel.model"));
    std::string text;
    for (std::string_view piece = *stream->next(); !piece.empty(); piece = *stream->next()) text += piece;
    return text;
}

Members members(const TriangleMesh& mesh) {
    Members sets;
    for (const FaceSet& set : mesh.sets) {
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            if (std::find(set.regions.begin(), set.regions.end(), mesh.regions[f]) != set.regions.end())
                sets[set.name].push_back(f);
        }
    }
    return sets;
}

TEST(Format3mfTest, MeshRegionsSetsAndUnitComeBack) {
    TriangleMesh mesh = torus(18, 9);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(1 + f * 3 / mesh.face_count());
    mesh.sets = {{"inlet & <outlet>", {1}}, {"caf\xC3\xA9", {2}}, {"ends", {1, 3}}};  // 3 is in no set of its own
    for (const LengthUnit unit : length_units()) {
        const std::string bytes = write_mesh(mesh, MeshFormat::k3mf, unit);
        const ReadResult same = must_read(bytes);
        EXPECT_EQ(same.format, MeshFormat::k3mf);
        EXPECT_EQ(same.unit, unit);
        EXPECT_EQ(same.mesh, mesh);
        EXPECT_EQ(write_mesh(same.mesh, MeshFormat::k3mf, unit), bytes);
    }
    mesh.sets.clear();
    EXPECT_EQ(members(must_read(write_mesh(mesh, MeshFormat::k3mf)).mesh).size(), 3U);
    EXPECT_EQ(must_read(write_mesh(mesh, MeshFormat::k3mf)).mesh.regions, mesh.regions);
}

TEST(Format3mfTest, AnOpenMeshIsASurface) {
    EXPECT_THAT(model_text(write_mesh(cube(), MeshFormat::k3mf)), HasSubstr("<object id=\"1\" type=\"model\">"));
    TriangleMesh open = cube();
    open.faces.pop_back();
    EXPECT_THAT(model_text(write_mesh(open, MeshFormat::k3mf)), HasSubstr("<object id=\"1\" type=\"surface\">"));
}

TEST(Format3mfTest, UnitsOfFileAndUser) {
    const auto in = [](const char* unit) { return file(object(1, ""), "<item objectid=\"1\"/>", unit); };
    EXPECT_EQ(must_read(in("")).unit, LengthUnit::kMillimetre) << "the format's default";
    EXPECT_EQ(must_read(in("unit=\"inch\"")).unit, LengthUnit::kInch);
    EXPECT_EQ(must_read(in("unit=\"micron\""), {.unit = LengthUnit::kMicrometre}).unit, LengthUnit::kMicrometre);
    const Error contrary = error_of(in("unit=\"meter\""), {.unit = LengthUnit::kFoot});
    EXPECT_EQ(contrary.cause, Cause::kInvalidOption);
    EXPECT_EQ(contrary.field, "unit");
    EXPECT_THAT(contrary.message, HasSubstr("lengths are in m, and ft is stated"));
    EXPECT_THAT(error_of(in("unit=\"yard\"")).message, HasSubstr("3D/3dmodel.model, line 2: expected a unit (micron"));

    const std::string obj = write_mesh(cube(), MeshFormat::kObj);
    EXPECT_EQ(must_read(obj).unit, std::nullopt);
    EXPECT_EQ(must_read(obj, {.unit = LengthUnit::kFoot}).unit, LengthUnit::kFoot);
}

TEST(Format3mfTest, WhatCannotBeWrittenIsSaidBefore) {
    EXPECT_TRUE(check_unit(MeshFormat::kObj, {}, {}));
    EXPECT_TRUE(check_unit(MeshFormat::kObj, LengthUnit::kInch, LengthUnit::kMetre));
    EXPECT_TRUE(check_unit(MeshFormat::k3mf, LengthUnit::kInch, {}));
    const Status conversion = check_unit(MeshFormat::kObj, {}, LengthUnit::kMetre);
    ASSERT_FALSE(conversion);
    EXPECT_EQ(conversion.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(conversion.error().field, "unit");
    EXPECT_FALSE(check_unit(MeshFormat::k3mf, {}, {}));
}

TEST(Format3mfTest, ItemsAndComponentsGoWhereTheyArePut) {
    // The component is turned by 90 degrees about z and moved; its item moves on. Rows are what the axes become.
    const std::string turned = "<components><component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 10 0 0\"/></components>";
    const ReadResult result =
        must_read(file(object(1, "") + object(2, "", turned),
                       "<item objectid=\"1\"/>\n<item objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 0 0 100\"/>\n"));
    ASSERT_EQ(result.mesh.face_count(), 8U);
    const std::vector<Vec3> expected = {{0, 0, 0},    {1, 0, 0},    {0, 1, 0},    {0, 0, 1},
                                        {20, 0, 100}, {20, 2, 100}, {18, 0, 100}, {20, 0, 102}};
    EXPECT_EQ(result.mesh.positions, expected);
    EXPECT_EQ(enclosed_volume(result.mesh), 1.0 / 6 + 8.0 / 6);
}

TEST(Format3mfTest, MirroredObjectsLookOutside) {
    const ReadResult result = must_read(file(object(1, ""), "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>"));
    EXPECT_EQ(enclosed_volume(result.mesh), 1.0 / 6);
}

TEST(Format3mfTest, ObjectsAreRegionsUnderTheirNames) {
    const std::string both =
        "<components><component objectid=\"1\"/><component objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 5 0 "
        "0\"/></components>";
    const std::string objects = object(1, "name=\"bolt &amp; nut\"") + object(2, "") + object(3, "name=\"pair\"", both);
    const TriangleMesh mesh = must_read(file(objects,
                                             "<item objectid=\"3\"/><item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 9 0 0\"/>"
                                             "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 7 0 0\"/>"))
                                  .mesh;
    EXPECT_EQ(mesh.regions, (std::vector<std::uint32_t>{1, 1, 1, 1, 2, 2, 2, 2, 1, 1, 1, 1, 3, 3, 3, 3}));
    EXPECT_EQ(members(mesh),
              (Members{{"bolt & nut", {0, 1, 2, 3, 8, 9, 10, 11}}, {"pair", {4, 5, 6, 7}}, {"object_2", {12, 13, 14, 15}}}));
    EXPECT_TRUE(must_read(file(object(1, "name=\"alone\""), "<item objectid=\"1\"/>")).mesh.regions.empty());
}

TEST(Format3mfTest, TriangleSetsOverlapAndAreNamedTwice) {
    const std::string sets =
        "<t:trianglesets><t:triangleset name=\"a\" identifier=\"1\"><t:refrange startindex=\"1\" endindex=\"2\"/><t:ref "
        "index=\"2\"/></t:triangleset><t:triangleset name=\"b\" identifier=\"2\"><t:ref index=\"2\"/><t:ref index=\"3\"/>"
        "</t:triangleset><t:triangleset name=\"none\" identifier=\"3\"/></t:trianglesets></mesh>";
    std::string mesh_with_sets = kTetrahedron;
    mesh_with_sets.replace(mesh_with_sets.find("</mesh>"), 7, sets);
    const TriangleMesh one = must_read(file(object(1, "name=\"a\"", mesh_with_sets), "<item objectid=\"1\"/>")).mesh;
    EXPECT_EQ(one.regions, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(members(one), (Members{{"a", {1, 2}}, {"b", {2, 3}}}));
    const std::string shift = "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 9 0 0\"/>";
    const TriangleMesh two = must_read(file(object(1, "name=\"o\"", mesh_with_sets), "<item objectid=\"1\"/>" + shift)).mesh;
    EXPECT_EQ(members(two), (Members{{"a", {1, 2, 5, 6}}, {"b", {2, 3, 6, 7}}})) << "one object, put twice";
}

TEST(Format3mfTest, ModelsInSeveralFiles) {
    // As slicers write them: the root is wherever the relationships say, objects are in files of their own.
    const std::string production =
        "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" requiredextensions=\"p\"";
    const std::string root =
        model(object(8, "name=\"whole\"", "<components><component p:path=\"/3D/Objects/a.model\" objectid=\"1\"/></components>"),
              "<item objectid=\"8\"/><item objectid=\"1\" p:path=\"/3D/objects/A.model\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/>",
              production);
    const Files files = {
        {"_rels/.rels",
         "<Relationships><Relationship Target=\"/other.png\" Type=\"thumbnail\"/><Relationship Id=\"r\" "
         "Target=\"/3D/root.model\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
        {"3D/root.model", root},
        {"3D/Objects/a.model", model(object(1, ""), "")}};
    const TriangleMesh mesh = must_read(archive_of(files)).mesh;
    EXPECT_EQ(mesh.face_count(), 8U);
    EXPECT_EQ(members(mesh).size(), 2U);
    EXPECT_THAT(error_of(archive_of({files[0], files[1]})).message, HasSubstr("no '3D/Objects/a.model'"));
}

TEST(Format3mfTest, SupportIsLeftOut) {
    const std::string objects = object(1, "") + object(2, "type=\"support\"");
    EXPECT_EQ(must_read(file(objects, "<item objectid=\"1\"/><item objectid=\"2\"/>")).mesh.face_count(), 4U);
    EXPECT_EQ(error_of(file(objects, "<item objectid=\"2\"/>")).cause, Cause::kEmptyInput);
}

TEST(Format3mfTest, OtherArchivesAndOtherXml) {
    const Error zip = error_of(archive_of({{"part.stl", "solid"}}));
    EXPECT_EQ(zip.cause, Cause::kUnknownFormat);
    EXPECT_THAT(zip.message, HasSubstr("zip archive without a 3MF model"));
    EXPECT_EQ(error_of(archive_of({{"3D/3dmodel.model", "<svg/>"}})).cause, Cause::kUnknownFormat);
    EXPECT_EQ(error_of(archive_of({{"3D/3dmodel.model", "no tag"}})).cause, Cause::kUnknownFormat);
    const Error beams =
        error_of(file(object(1, ""), "<item objectid=\"1\"/>", "xmlns:v=\"http://example.org/voxels\" requiredextensions=\"v\""));
    EXPECT_EQ(beams.cause, Cause::kUnsupported);
    EXPECT_THAT(beams.message, HasSubstr("http://example.org/voxels"));
}

TEST(Format3mfTest, BrokenModelsAreNamedWithTheirLine) {
    const std::string item = "<item objectid=\"1\"/>";
    const auto broken = [&](const std::string& from, const std::string& to) {
        std::string content = kTetrahedron;
        content.replace(content.find(from), from.size(), to);
        return error_of(file(object(1, "", content), item));
    };
    const auto expect = [](const Error& error, Cause cause, const std::string& what) {
        EXPECT_EQ(cause_name(error.cause), cause_name(cause)) << error.message;
        EXPECT_THAT(error.message, HasSubstr("3D/3dmodel.model, line "));
        EXPECT_THAT(error.message, HasSubstr(what));
    };
    expect(broken("x=\"1\"", "x=\"one\""), Cause::kMalformedInput, "line 4: expected a number as x of <vertex>, found 'one'");
    expect(broken("x=\"1\"", ""), Cause::kMalformedInput, "found none");
    expect(broken("x=\"1\"", "x=\"nan\""), Cause::kInvalidCoordinate, "line 4");
    expect(broken("v1=\"1\"", "v1=\"4\""), Cause::kIndexOutOfRange, "4");
    expect(broken("v1=\"1\"", "v1=\"-1\""), Cause::kIndexOutOfRange, "-1");
    expect(broken("v1=\"1\"", "v1=\"1.5\""), Cause::kMalformedInput, "v1 of <triangle>");
    expect(error_of(file(object(1, ""), "<item objectid=\"7\"/>")), Cause::kMalformedInput, "object 7 is not defined");
    expect(error_of(file(object(1, "") + object(1, ""), item)), Cause::kMalformedInput, "defined a second time");
    const std::string self = "<components><component objectid=\"1\"/></components>";
    expect(error_of(file(object(1, "", self), item)), Cause::kMalformedInput, "object 1 is not defined");
    const std::string ahead = "<components><component objectid=\"2\"/></components>";
    expect(error_of(file(object(1, "", ahead) + object(2, ""), item)), Cause::kMalformedInput, "object 2 is not defined");
    const auto moved = [](const std::string& transform) {
        return error_of(file(object(1, ""), "<item objectid=\"1\" transform=\"" + transform + "\"/>"));
    };
    expect(moved("1 0 0 0 1 0 0 0 1 0 0"), Cause::kMalformedInput, "12 numbers");
    expect(moved("1 0 0 0 1 0 0 0 1 0 0 0 0"), Cause::kMalformedInput, "12 numbers");
    expect(moved("1 0 0 0 1 0 0 0 inf 0 0 0"), Cause::kMalformedInput, "12 numbers");
    expect(moved("1 0 0 0 1 0 0 0 0 0 0 0"), Cause::kMalformedInput, "flattens");
    expect(moved("1 0 0 0 1 0 0 0 1e20 0 0 0"), Cause::kInvalidCoordinate, "1e+20");
    const std::string whole = model(object(1, ""), item);
    expect(error_of(archive_of({{"3D/3dmodel.model", whole.substr(0, whole.size() - 10)}})), Cause::kTruncatedInput, "</model>");
    expect(error_of(file("<vertex x=\"0\" y=\"0\" z=\"0\"/>", item)), Cause::kMalformedInput, "outside of an object");
    EXPECT_EQ(error_of(file(object(1, ""), "")).cause, Cause::kEmptyInput);
    EXPECT_EQ(error_of(file(object(1, "", ""), item)).cause, Cause::kEmptyInput);
}

/// The archive with the first byte of `from` changed.
std::string with_changed_byte(std::string archive, const std::string& from, char to) {
    archive[archive.find(from)] = to;
    return archive;
}

/// An archive of one file that is not packed, with the checksum and size it is said to have.
std::string stored_archive(const std::string& name, const std::string& text, std::uint32_t crc, std::uint32_t size) {
    const auto put = [](std::string& to, std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i) & 0xFFU);
    };
    std::string common;  // what header and table have both
    for (const std::uint32_t value : {20U, 0U, 0U, 0U, 0U}) put(common, value, 2);
    put(common, crc, 4);
    put(common, size, 4);
    put(common, size, 4);
    put(common, static_cast<std::uint32_t>(name.size()), 2);
    put(common, 0, 2);
    std::string archive = "PK\x03\x04" + common + name + text;
    const auto table = static_cast<std::uint32_t>(archive.size());
    archive += "PK\x01\x02";
    put(archive, 20, 2);
    archive += common + std::string(14, '\0') + name;
    const auto bytes = static_cast<std::uint32_t>(archive.size()) - table;
    archive += "PK\x05\x06" + std::string(4, '\0');
    put(archive, 1, 2);
    put(archive, 1, 2);
    put(archive, bytes, 4);
    put(archive, table, 4);
    return archive + std::string(2, '\0');
}

TEST(Format3mfTest, DamageIsSeenBehindTheLastTagToo) {
    const std::string text = model(object(1, ""), "<item objectid=\"1\"/>");
    const std::string deflated = archive_of({{"x", text}});
    const std::uint32_t crc = ZipReader::open(std::as_bytes(std::span(deflated)))->find("x")->crc;
    const auto size = static_cast<std::uint32_t>(text.size());
    const std::string good = stored_archive("3D/3dmodel.model", text, crc, size);
    EXPECT_EQ(must_read(good).mesh.face_count(), 4U);
    const Error changed = error_of(with_changed_byte(good, "1\" y=\"0\" z=\"0\"", '7'));
    EXPECT_EQ(changed.cause, Cause::kMalformedInput);
    EXPECT_THAT(changed.message, HasSubstr("does not have its checksum"));
    const std::string links =
        "<Relationships><Relationship Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" "
        "Target=\"/3D/3dmodel.model\"/></Relationships>";
    EXPECT_THAT(error_of(stored_archive("_rels/.rels", links, crc, static_cast<std::uint32_t>(links.size()))).message,
                HasSubstr("does not have its checksum"));
}

TEST(Format3mfTest, TheCoreMayHaveAPrefix) {
    const std::string plain = model(object(1, ""), "<item objectid=\"1\"/>");
    std::string prefixed;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        prefixed += plain[i];
        if (plain[i] != '<' || plain[i + 1] == '?') continue;
        if (plain[i + 1] == '/') prefixed += plain[++i];
        prefixed += "m:";
    }
    prefixed.replace(prefixed.find("xmlns="), 6, "xmlns:m=");
    EXPECT_EQ(must_read(archive_of({{"3D/3dmodel.model", prefixed}})).mesh,
              must_read(file(object(1, ""), "<item objectid=\"1\"/>")).mesh);
    prefixed.replace(prefixed.find("core/2015"), 9, "gone/2015");
    EXPECT_EQ(error_of(archive_of({{"3D/3dmodel.model", prefixed}})).cause, Cause::kUnknownFormat);
}

TEST(Format3mfTest, XmlThatIsNotWellFormedIsRefused) {
    std::string text = model(object(1, ""), "<item objectid=\"1\"/>");
    text.replace(text.find("</vertices>"), 11, "</vertexes>");
    std::erase(text, '\n');
    const std::string column = std::to_string(text.find("</vertexes>") + 1);
    EXPECT_THAT(
        error_of(archive_of({{"3D/3dmodel.model", text}})).message,
        HasSubstr("line 1, column " + column + ": expected '</vertices>', the end of the tag of line 1, found '</vertexes>'"));
}

TEST(Format3mfTest, BombsAreRefusedBeforeMemoryIsTaken) {
    // Each object is two of the one before: 2^40 tetrahedra in a few KiB.
    std::string objects = object(1, "");
    for (int id = 2; id <= 41; ++id) {
        objects += object(id, "", components(id - 1, 2));
    }
    EXPECT_EQ(error_of(file(objects, "<item objectid=\"41\"/>")).cause, Cause::kLimitExceeded);
    EXPECT_EQ(error_of(file(objects, "<item objectid=\"12\"/>"), {.max_faces = 8191}).cause, Cause::kLimitExceeded);
    EXPECT_EQ(must_read(file(objects, "<item objectid=\"12\"/>"), {.max_faces = 8192}).mesh.face_count(), 8192U);
    // The same with nothing at the bottom, and a long chain of single components.
    std::string nothing = object(1, "", "");
    std::string chain = object(1, "");
    for (int id = 2; id <= 100; ++id) {
        nothing += object(id, "", components(id - 1, 2));
        chain += object(id, "", components(id - 1, 1));
    }
    EXPECT_THAT(error_of(file(nothing, "<item objectid=\"40\"/>")).message, HasSubstr("a million objects"));
    EXPECT_THAT(error_of(file(chain, "<item objectid=\"100\"/>")).message, HasSubstr("64 deep"));
    EXPECT_EQ(must_read(file(chain, "<item objectid=\"64\"/>")).mesh.face_count(), 4U);
    // Millions of what takes memory, each a few packed bits: vertices no face uses, objects, components.
    std::string vertices = "<mesh><vertices>";
    for (int i = 0; i < 301; ++i) vertices += "<vertex x=\"0\" y=\"0\" z=\"0\"/>";
    EXPECT_THAT(error_of(file(object(1, "", vertices + "</vertices></mesh>"), ""), {.max_faces = 100}).message,
                HasSubstr("over three vertices for each face"));
    std::string many;
    for (int i = 0; i < 1'000'001; ++i) many += "<item objectid=\"1\"/>";
    EXPECT_THAT(error_of(file(object(1, "", ""), many)).message, HasSubstr("over a million objects, components"));
    // XML that is nothing but space.
    const std::string space = archive_of({{"3D/3dmodel.model", std::string(4'000'000, ' ')}});
    EXPECT_LT(space.size(), 10'000U);
    EXPECT_EQ(unpacked_size(std::as_bytes(std::span(space))), 4'000'000U);
    const Error refused = error_of(space, {.max_faces = 1000});
    EXPECT_EQ(refused.cause, Cause::kLimitExceeded);
    EXPECT_THAT(refused.message, HasSubstr("unpacks to 4000000 bytes"));
    std::string ranges;
    for (int i = 0; i < 2; ++i) ranges += "<t:refrange startindex=\"0\" endindex=\"90000000\"/>";
    EXPECT_EQ(error_of(file(object(1, "", "<t:triangleset name=\"s\">" + ranges + "</t:triangleset>"), "")).cause,
              Cause::kLimitExceeded);
}

}  // namespace
}  // namespace vsplit::test
