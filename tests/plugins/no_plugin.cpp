/// Refused: a shared library that exports something, but no plugin.

#include <boost/config.hpp>

extern "C" BOOST_SYMBOL_EXPORT int answer() { return 42; }
