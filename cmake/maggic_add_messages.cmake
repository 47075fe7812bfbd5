# maggic_add_messages(TARGET file.proto...)
#
# Makes a static library of the C++ classes protoc writes for the messages of the current folder,
# included as "<file>.pb.h". The files ask for protobuf's light runtime: it keeps no list of messages
# for the whole program, so two plugins, or a plugin and a program, may each know the same message.
function(maggic_add_messages target)
  add_library(${target} STATIC)
  protobuf_generate(TARGET ${target} LANGUAGE cpp PROTOS ${ARGN}
    IMPORT_DIRS ${CMAKE_CURRENT_SOURCE_DIR} PROTOC_OUT_DIR ${CMAKE_CURRENT_BINARY_DIR})
  # Not linked to maggic_warnings, and a system folder to those who include it: what protoc writes is
  # not ours to keep free of warnings.
  target_include_directories(${target} SYSTEM PUBLIC ${CMAKE_CURRENT_BINARY_DIR})
  target_link_libraries(${target} PUBLIC protobuf::libprotobuf-lite)
  set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON CXX_CLANG_TIDY "")
endfunction()
