// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_stamps.h"

#include <chrono>
#include <regex>

#include "core/util/error.h"
#include "harness/datasets/files/text_table.h"

namespace vinebench::harness {
namespace {

constexpr std::chrono::days kMostDays(146 * 365);  // less than kMostStamp

Stamp stamp_of(const TableRow& row) {
  static const std::regex date_form(R"((\d{4})-(\d{2})-(\d{2}))");
  static const std::regex time_form(R"((\d{2}):(\d{2}):(\d{2}(\.\d{1,9})?))");
  std::smatch date, time;
  if (row.fields.size() != 2 || !std::regex_match(row.fields[0], date, date_form) ||
      !std::regex_match(row.fields[1], time, time_form)) {
    row.fault("expected a date and a time: 2011-09-26 13:02:25.964389445");
  }
  const auto number = [](const std::ssub_match& digits) { return std::stoi(digits.str()); };
  const std::chrono::year_month_day day{std::chrono::year(number(date[1])),
                                        std::chrono::month(static_cast<unsigned>(number(date[2]))),
                                        std::chrono::day(static_cast<unsigned>(number(date[3])))};
  const int hours = number(time[1]), minutes = number(time[2]);
  if (!day.ok() || hours >= 24 || minutes >= 60) {
    row.fault(fmt::format("'{} {}' is not a time", row.fields[0], row.fields[1]));
  }
  const auto days = std::chrono::sys_days(day).time_since_epoch();
  if (days < -kMostDays || days > kMostDays) row.fault("expected a time within 146 years of 1970");
  return std::chrono::nanoseconds(days + std::chrono::hours(hours) + std::chrono::minutes(minutes))
             .count() +
         parse_seconds(time[3].str());
}

}  // namespace

std::vector<Stamp> read_kitti_stamps(const std::filesystem::path& file) {
  std::vector<Stamp> stamps;
  for (const TableRow& row : read_rows(file)) stamps.push_back(stamp_of(row));
  return stamps;
}

}  // namespace vinebench::harness
