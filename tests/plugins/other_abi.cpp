/// Refused: exports the alias of a later ABI. Loading it would end the test program.

#include <cstdlib>
#include <vector>

#include <boost/dll/alias.hpp>

namespace {

const int descriptor_of_the_future = 0;

struct RunsWhenLoaded {
  RunsWhenLoaded() { std::abort(); }
};
const RunsWhenLoaded runs_when_loaded;

}  // namespace

BOOST_DLL_ALIAS(descriptor_of_the_future, maggic_plugin_v4)
