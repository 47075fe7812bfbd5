/// Refused: its descriptor is shorter than this program's; the rest of it must not be read.

#include <cstdint>
#include <vector>

#include <boost/dll/alias.hpp>

namespace {

struct EarlierDescriptor {
  std::uint32_t size = sizeof(EarlierDescriptor);
};
const EarlierDescriptor descriptor;

}  // namespace

BOOST_DLL_ALIAS(descriptor, maggic_plugin_v3)
