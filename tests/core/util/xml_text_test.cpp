// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/xml_text.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

TEST(XmlTextTest, EscapesMarkupAndLineEnds) {
  EXPECT_EQ(xml_escaped("a < b && \"c\" > d"), "a &lt; b &amp;&amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(xml_escaped("one\ntwo\tthree"), "one&#10;two\tthree");
}

TEST(XmlTextTest, LeavesOutWhatXmlHasNot) {
  EXPECT_EQ(xml_escaped("re\x1b[1md"), "re[1md");
  EXPECT_EQ(xml_escaped("Rebst\xc3\xb6"
                        "cke"),
            "Rebst\xc3\xb6"
            "cke");                                  // UTF-8 stays
  EXPECT_EQ(xml_escaped("a\xff"), "a\xef\xbf\xbd");  // bytes of no UTF-8 do not
}

}  // namespace
}  // namespace vinebench
