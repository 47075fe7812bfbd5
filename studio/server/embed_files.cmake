# cmake -DFOLDER=… -DFILES=a;b -DOUTPUT=x.cpp -P embed_files.cmake
#
# Writes the files, paths below FOLDER, as the C++ of page_files() of page_files.hpp.
set(arrays "")
set(entries "")
set(number 0)
foreach(path IN LISTS FILES)
  file(READ "${FOLDER}/${path}" hex HEX)
  file(SIZE "${FOLDER}/${path}" bytes)
  file(SHA256 "${FOLDER}/${path}" sha256)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," values "${hex}")
  # The zero is for files that are empty; an array cannot be.
  string(APPEND arrays "constexpr char kFile${number}[] = {${values}'\\0'};\n")
  string(APPEND entries "      {\"${path}\", {kFile${number}, ${bytes}}, \"${sha256}\"},\n")
  math(EXPR number "${number} + 1")
endforeach()

file(WRITE "${OUTPUT}" "#include \"studio/server/page_files.hpp\"

namespace maggic::studio {
namespace {

${arrays}
}  // namespace

std::span<const PageFile> page_files() {
  static constexpr PageFile kFiles[] = {
${entries}  };
  return kFiles;
}

}  // namespace maggic::studio
")
