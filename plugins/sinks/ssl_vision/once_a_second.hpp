#pragma once
/// Something done with the first frame and then once a second of the frames' own time.

#include <chrono>
#include <optional>

#include "maggic/frame.hpp"

namespace maggic::ssl_vision {

class OnceASecond {
 public:
  /// A clock that went back by any amount does not delay it.
  bool is_due(Timestamp captured) const {
    return !last_ || captured < *last_ || captured - *last_ >= std::chrono::seconds(1);
  }
  void note_done(Timestamp captured) { last_ = captured; }

 private:
  std::optional<Timestamp> last_;
};

}  // namespace maggic::ssl_vision
