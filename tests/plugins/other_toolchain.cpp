/// Refused: says that it was built by a compiler whose C++ objects are laid out otherwise.

#include "maggic/plugin.hpp"

namespace {

const maggic::PluginDescriptor descriptor{sizeof(maggic::PluginDescriptor),
                                          "libc++ cxxabi 1 c++2b",
                                          maggic::StageKind::kSink,
                                          MAGGIC_PLUGIN_NAME,
                                          "speaks another C++",
                                          nullptr,
                                          nullptr};

}  // namespace

BOOST_DLL_ALIAS(descriptor, MAGGIC_PLUGIN_ALIAS)
