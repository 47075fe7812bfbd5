#include "maggic/picture_name.hpp"

#include <gtest/gtest.h>

namespace maggic {
namespace {

TEST(PictureName, IsJudgedByItsExtensionInAnyCase) {
  EXPECT_TRUE(has_picture_extension("field.png"));
  EXPECT_TRUE(has_picture_extension("a folder/IMG_0001.JPG"));
  EXPECT_TRUE(has_picture_extension("scan.v2.Tiff"));
}

TEST(PictureName, NothingElseIsAPicture) {
  for (const char* name :
       {"", "png", ".png", "film.mp4", "notes.txt", "png/readme", "a.png.part"}) {
    EXPECT_FALSE(has_picture_extension(name)) << name;
  }
}

}  // namespace
}  // namespace maggic
