# The C++ of vsplit_embed_folder (VsplitEmbed.cmake): cmake -D FOLDER= -D HEADER= -D FUNCTION= -D SYMBOL= -D SOURCE= -P embed_folder.cmake
string(REGEX MATCH "^(.*)::([^:]*)$" matched ${FUNCTION})
set(namespace ${CMAKE_MATCH_1})
set(name ${CMAKE_MATCH_2})
file(GLOB_RECURSE paths LIST_DIRECTORIES false RELATIVE ${FOLDER} ${FOLDER}/*)
list(SORT paths)
set(bytes "")
set(symbols "")
set(rows "")
set(number 0)
foreach(path ${paths})
  set(symbol embedded_${SYMBOL}_${number})
  string(APPEND bytes "asm(\".section .rodata\\n.global ${symbol}, ${symbol}_end\\n${symbol}:\\n.incbin \\\"${FOLDER}/${path}\\\"\\n\"\n"
    "    \"${symbol}_end:\\n.byte 0\\n.previous\\n\");\n")
  string(APPEND symbols "extern \"C\" const char ${symbol}[];\nextern \"C\" const char ${symbol}_end[];\n")
  string(APPEND rows "        EmbeddedFile{\"${path}\", {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(CONFIGURE OUTPUT ${SOURCE} @ONLY CONTENT [[
#include "@HEADER@"

#include <array>
#include <cstddef>

@bytes@
@symbols@
namespace @namespace@ {

std::span<const EmbeddedFile> @name@() {
    static const std::array files{
@rows@    };
    return files;
}

}  // namespace @namespace@
]])
