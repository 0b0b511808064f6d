// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/labels.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace vinebench {
namespace {

TEST(LabelsTest, EveryLabelIsFoundByItsName) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kLabels; ++i) {
    const auto label = static_cast<Label>(i);
    EXPECT_EQ(label_named(name_of(label)), label);
    names.insert(name_of(label));
    EXPECT_EQ(yaml_names(Label{}).at(i), name_of(label));
  }
  EXPECT_EQ(names.size(), kLabels);
  EXPECT_THROW(name_of(static_cast<Label>(kLabels)), std::out_of_range);
}

// Files store the names: a label that is inserted must not shift those behind it.
TEST(LabelsTest, NamesStandAtTheirLabels) {
  EXPECT_STREQ(name_of(Label::kSky), "sky");
  EXPECT_STREQ(name_of(Label::kTrunk), "trunk");
  EXPECT_STREQ(name_of(Label::kLeaf), "leaf");
  EXPECT_STREQ(name_of(Label::kBox), "box");
  EXPECT_STREQ(name_of(Label::kPerson), "person");
}

TEST(LabelsTest, AnUnknownNameIsNoLabel) {
  EXPECT_EQ(label_named("leaves"), std::nullopt);
  EXPECT_EQ(label_named(""), std::nullopt);
}

TEST(ThingsTest, NamesStandAtTheirThings) {
  EXPECT_EQ(name_of(Thing::kNone), "none");
  EXPECT_EQ(name_of(Thing::kVine), "vine");
  EXPECT_EQ(name_of(Thing::kRover), "rover");
  EXPECT_EQ(name_of(Thing::kCover), "cover");
}

}  // namespace
}  // namespace vinebench
