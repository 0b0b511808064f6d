// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/occlusion.h"

#include <gtest/gtest.h>

#include <set>

namespace vinebench {
namespace {

TEST(OcclusionTest, SumsItsClassesAndNamesTheLargest) {
  Occlusion occlusion;
  EXPECT_EQ(occlusion.total(), 0);
  occlusion.share(OccluderClass::kCrate) = 0.25;
  occlusion.share(OccluderClass::kTarpaulin) = 0.5;
  EXPECT_EQ(occlusion.total(), 0.75);
  EXPECT_EQ(occlusion.largest(), OccluderClass::kTarpaulin);
  EXPECT_EQ(occlusion.share(OccluderClass::kPerson), 0);
}

TEST(OcclusionTest, EachClassHasANameAndALabelOfItsOwn) {
  std::set<std::string> names;
  std::set<Label> labels;
  for (std::size_t i = 0; i < kOccluderClasses; ++i) {
    names.insert(name_of(static_cast<OccluderClass>(i)));
    labels.insert(label_of(static_cast<OccluderClass>(i)));
  }
  EXPECT_EQ(names.size(), kOccluderClasses);
  EXPECT_EQ(labels.size(), kOccluderClasses);
  EXPECT_FALSE(labels.contains(Label::kSky));  // what an entry that is missing would have
  EXPECT_EQ(name_of(OccluderClass::kTarpaulin), "tarpaulin");
}

}  // namespace
}  // namespace vinebench
