# Bytes of a file as a part of the program:
#   vsplit_embed(TARGET vsplit_rest FILE ${file} HEADER rest/schema_bytes.h FUNCTION vsplit::rest::schema_bytes)
# defines `std::string_view FUNCTION()`, which HEADER declares. FILE may be made by the build. ELF only, g++ and clang.
function(vsplit_embed)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "TARGET;FILE;HEADER;FUNCTION" "")
  string(REPLACE "::" "_" symbol ${arg_FUNCTION})
  string(REGEX MATCH "^(.*)::([^:]*)$" matched ${arg_FUNCTION})
  set(namespace ${CMAKE_MATCH_1})
  set(name ${CMAKE_MATCH_2})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${symbol}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
#include "@arg_HEADER@"

#include <cstddef>

asm(".section .rodata\n"
    ".global embedded_@symbol@\n"
    ".global embedded_@symbol@_end\n"
    "embedded_@symbol@:\n"
    ".incbin \"@arg_FILE@\"\n"
    "embedded_@symbol@_end:\n"
    ".byte 0\n"
    ".previous\n");

extern "C" const char embedded_@symbol@[];
extern "C" const char embedded_@symbol@_end[];

namespace @namespace@ {

std::string_view @name@() {
    return {embedded_@symbol@, static_cast<std::size_t>(embedded_@symbol@_end - embedded_@symbol@)};
}

}  // namespace @namespace@
]])
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${arg_FILE})
  target_sources(${arg_TARGET} PRIVATE ${source})
endfunction()

# All files of a folder that the build makes, under names that are not known before:
#   vsplit_embed_folder(TARGET vsplitd FOLDER ${out} MADE_BY target MARK ${out}/index.html HEADER ops/page_bytes.h FUNCTION vsplit::ops::f)
# defines `std::span<const EmbeddedFile> FUNCTION()`, sorted by path, which HEADER declares with EmbeddedFile{path, bytes}. MARK is a file
# of the folder that is new whenever another one is.
function(vsplit_embed_folder)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "TARGET;FOLDER;MADE_BY;MARK;HEADER;FUNCTION" "")
  string(REPLACE "::" "_" symbol ${arg_FUNCTION})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${symbol}.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_folder.cmake)
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -D FOLDER=${arg_FOLDER} -D HEADER=${arg_HEADER} -D FUNCTION=${arg_FUNCTION} -D SYMBOL=${symbol}
      -D SOURCE=${source} -P ${script}
    DEPENDS ${arg_MADE_BY} ${arg_MARK} ${script}
    COMMENT "Embedding ${arg_FOLDER}"
    VERBATIM)
  target_sources(${arg_TARGET} PRIVATE ${source})
endfunction()
