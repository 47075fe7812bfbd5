/// Refused: a descriptor by hand that forgot how stages are made.

#include "maggic/plugin.hpp"

namespace {

const maggic::PluginDescriptor descriptor{sizeof(maggic::PluginDescriptor),
                                          MAGGIC_TOOLCHAIN,
                                          maggic::StageKind::kSink,
                                          MAGGIC_PLUGIN_NAME,
                                          "makes nothing",
                                          nullptr,
                                          nullptr};

}  // namespace

BOOST_DLL_ALIAS(descriptor, MAGGIC_PLUGIN_ALIAS)
