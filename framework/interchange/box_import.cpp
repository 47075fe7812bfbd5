/// The XML of the legacy boxes as parameters of yuv_boxes.

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/wording.hpp"
#include "interchange/imported_blocks.hpp"

namespace maggic {
namespace {

struct KnownColor {
  std::string_view theirs;
  std::string_view ours;
};
/// In the order in which their program tries the boxes, which is not the file's.
constexpr std::array<KnownColor, 9> kColors{{{"Orange", "orange"},
                                             {"Blue", "blue"},
                                             {"Yellow", "yellow"},
                                             {"Red", "red"},
                                             {"Green", "green"},
                                             {"Pink", "magenta"},
                                             {"LightBlue", "cyan"},
                                             {"Purple", "purple"},
                                             {"Brown", "brown"}}};
constexpr std::string_view kNoColor = "NoCOL";
constexpr std::string_view kStrangeColor = "ColorStrange";  // tried last, and nothing of ours
constexpr std::size_t kMaxBoxes = 8;                        // of yuv_boxes

/// A box of zeros holds Y 0, U 0, V 0 alone, which no colour has: their programs write it for
/// colours that are not used.
bool is_unset(const YuvBoxFile::Box& box) {
  return box.min == std::array<int, 3>{} && box.max == std::array<int, 3>{};
}

bool is_empty(const YuvBoxFile::Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.min[axis] > box.max[axis]) return true;
  }
  return false;
}

enum class Subtraction { kNothingLeft, kBox, kNoBox };

/// Takes `hole` out of `box` where what is left is a box again.
Subtraction subtract(const YuvBoxFile::Box& hole, YuvBoxFile::Box& box) {
  std::size_t axes_covered = 0;
  std::size_t open_axis = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (hole.max[axis] < box.min[axis] || hole.min[axis] > box.max[axis]) return Subtraction::kBox;
    if (hole.min[axis] <= box.min[axis] && hole.max[axis] >= box.max[axis]) {
      ++axes_covered;
    } else {
      open_axis = axis;
    }
  }
  if (axes_covered == 3) return Subtraction::kNothingLeft;
  if (axes_covered < 2) return Subtraction::kNoBox;
  if (hole.min[open_axis] <= box.min[open_axis]) {
    box.min[open_axis] = hole.max[open_axis] + 1;
  } else if (hole.max[open_axis] >= box.max[open_axis]) {
    box.max[open_axis] = hole.min[open_axis] - 1;
  } else {
    return Subtraction::kNoBox;
  }
  return Subtraction::kBox;
}

class BoxImport {
 public:
  explicit BoxImport(const YuvBoxFile& file) : file_(file) {}

  ImportedBlock take() {
    block_.yaml = commented_line("  yuv_boxes:", "with the normalizer `none`, as there");
    add_gray_threshold();
    block_.yaml += commented_line("    boxes:", "[min, max], both included, as there");
    for (const KnownColor& color : kColors) {
      if (const YuvBoxFile::Box* box = find(color.theirs)) add(*box, color);
    }
    add_notes();
    if (boxes_ == 0) {
      throw ConfigError({mistake_at(file_.place, "found no colour with a box, expected one")});
    }
    block_.found = fmt::format("{} boxes for yuv_boxes", boxes_);
    return std::move(block_);
  }

 private:
  const YuvBoxFile::Box* find(std::string_view name) const {
    const auto found = std::ranges::find(file_.boxes, name, &YuvBoxFile::Box::name);
    return found == file_.boxes.end() ? nullptr : &*found;
  }

  void add_gray_threshold() {
    if (!file_.gray_scale) return;
    const PlacedNumber& scale = *file_.gray_scale;
    if (scale.value == 0) {
      block_.notes.push_back(
          fmt::format("{}: GrayScale 0 filters nothing: left out", source_text(scale.place)));
      return;
    }
    block_.yaml += commented_line(
        fmt::format("    gray_threshold: {}", scale.value - 1),
        fmt::format("{}: GrayScale {} less 1, as there only a smaller spread is gray",
                    source_text(scale.place), scale.value));
  }

  void add(YuvBoxFile::Box box, const KnownColor& color) {
    if (is_unset(box)) {
      unset_.push_back(color.theirs);
      return;
    }
    if (is_empty(box)) {
      block_.notes.push_back(
          fmt::format("{}: {} has a smallest value above its largest, so its box "
                      "holds nothing: left out",
                      source_text(box.place), box.name));
      return;
    }
    std::string source = source_text(box.place);
    if (!take_out_background(box, source)) return;
    if (boxes_ == kMaxBoxes) {
      block_.notes.push_back(
          fmt::format("{}: {} is the ninth box, and yuv_boxes holds {}: left out, so its colours "
                      "are background",
                      source_text(box.place), box.name, kMaxBoxes));
      return;
    }
    ++boxes_;
    block_.yaml += commented_line(
        fmt::format("      {}: {{y: [{}, {}], u: [{}, {}], v: [{}, {}]}}", color.ours, box.min[0],
                    box.max[0], box.min[1], box.max[1], box.min[2], box.max[2]),
        source);
  }

  /// NoCOL is tried before every colour. @return whether anything is left of the box.
  bool take_out_background(YuvBoxFile::Box& box, std::string& source) {
    const YuvBoxFile::Box* background = find(kNoColor);
    if (background == nullptr || is_unset(*background) || is_empty(*background)) return true;
    const YuvBoxFile::Box whole = box;
    switch (subtract(*background, box)) {
      case Subtraction::kBox:
        if (box.min != whole.min || box.max != whole.max) source += ", less NoCOL's box";
        return true;
      case Subtraction::kNothingLeft:
        block_.notes.push_back(
            fmt::format("{}: {} lies in NoCOL's box, which is background and comes first: left out",
                        source_text(box.place), box.name));
        return false;
      case Subtraction::kNoBox: break;
    }
    throw ConfigError({mistake_at(
        background->place,
        fmt::format("found a box for NoCOL that takes a piece out of {}'s (line {}) and leaves no "
                    "box, expected none, or one that leaves boxes: yuv_boxes has no box for "
                    "background",
                    box.name, box.place.line))});
  }

  void add_notes() {
    if (!unset_.empty()) {
      block_.notes.push_back(fmt::format("{}: no box (all zeros) for {}: left out",
                                         source_text({file_.place.file, 0, 0}),
                                         fmt::join(unset_, ", ")));
    }
    const YuvBoxFile::Box* strange = find(kStrangeColor);
    if (strange != nullptr && !is_unset(*strange) && !is_empty(*strange)) {
      block_.notes.push_back(
          fmt::format("{}: {} is no colour of ours: left out, so its colours "
                      "are background",
                      source_text(strange->place), strange->name));
    }
  }

  const YuvBoxFile& file_;
  ImportedBlock block_;
  std::size_t boxes_ = 0;
  std::vector<std::string_view> unset_;
};

}  // namespace

ImportedBlock import_boxes(const YuvBoxFile& file) { return BoxImport(file).take(); }

}  // namespace maggic
