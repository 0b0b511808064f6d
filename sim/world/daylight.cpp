// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/daylight.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/geometry/angle.h"
#include "core/util/error.h"

namespace vinebench::sim {
namespace {

using std::numbers::pi;
constexpr double kNominalElevation = 50 * kRadiansPerDegree;

bool read_date(const std::string& text, std::chrono::year_month_day& date) {
  int year = 0, read = 0;
  unsigned month = 0, day = 0;
  const int fields = std::sscanf(text.c_str(), "%4d-%2u-%2u%n", &year, &month, &day, &read);
  date = std::chrono::year(year) / std::chrono::month(month) / std::chrono::day(day);
  return fields == 3 && read == static_cast<int>(text.size()) && date.ok();
}

bool read_time(const std::string& text, double& hours) {
  unsigned hour = 0, minute = 0, second = 0;
  int read = 0;
  const int size = static_cast<int>(text.size());
  const bool long_form =
      std::sscanf(text.c_str(), "%2u:%2u:%2u%n", &hour, &minute, &second, &read) == 3;
  if (!long_form) {
    second = 0;
    if (std::sscanf(text.c_str(), "%2u:%2u%n", &hour, &minute, &read) != 2) return false;
  }
  hours = hour + minute / 60.0 + second / 3600.0;
  return read == size && hour < 24 && minute < 60 && second < 60;
}

/// Relative air mass, 1 at the zenith (Kasten and Young, Applied Optics 28, 1989).
double air_mass(double elevation) {
  const double degrees = std::max(0.0, elevation / kRadiansPerDegree);
  return 1 /
         (std::sin(degrees * kRadiansPerDegree) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
}

/// Transmission of the sun's red, green and blue through clear rural air.
Eigen::Vector3d transmission(double elevation) {
  const Eigen::Array3d optical_depth(0.12, 0.17, 0.26);
  return (-optical_depth * air_mass(elevation)).exp();
}

/// Light of the sky relative to that with the nominal sun, with twilight below the horizon.
double sky_brightness(double elevation) {
  const auto day = [](double e) { return 0.22 + 0.78 * std::sin(e); };
  const double above = day(std::max(0.0, elevation)) / day(kNominalElevation);
  // Civil twilight decreases by a factor of about 100 over six degrees.
  return above * std::pow(10.0, std::min(0.0, elevation / (3 * kRadiansPerDegree)));
}

}  // namespace

bool SunConfig::is_date(const std::string& text) {
  std::chrono::year_month_day date;
  return read_date(text, date);
}

bool SunConfig::is_time(const std::string& text) {
  double hours = 0;
  return read_time(text, hours);
}

SunPosition sun_position(const SunConfig::At& at) {
  std::chrono::year_month_day date;
  double hours = 0;
  if (!read_date(at.date, date)) fail("'{}' is no date, expected YYYY-MM-DD", at.date);
  if (!read_time(at.time, hours)) fail("'{}' is no time, expected HH:MM", at.time);
  constexpr double kUnixToJ2000 = 10957.5;  // days
  const double n =
      std::chrono::sys_days(date).time_since_epoch().count() + hours / 24 - kUnixToJ2000;
  const double mean_longitude = (280.460 + 0.9856474 * n) * kRadiansPerDegree;
  const double anomaly = (357.528 + 0.9856003 * n) * kRadiansPerDegree;
  const double longitude =
      mean_longitude +
      (1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * kRadiansPerDegree;
  const double obliquity = (23.439 - 4e-7 * n) * kRadiansPerDegree;
  const double ascension =
      std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  const double sidereal_hours = 6.697375 + 0.0657098242 * n + hours;
  const double hour_angle =
      (15 * sidereal_hours + at.longitude_deg) * kRadiansPerDegree - ascension;
  const double latitude = at.latitude_deg * kRadiansPerDegree;
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double north = std::sin(declination) * std::cos(latitude) -
                       std::cos(declination) * std::cos(hour_angle) * std::sin(latitude);
  const double up = std::sin(declination) * std::sin(latitude) +
                    std::cos(declination) * std::cos(hour_angle) * std::cos(latitude);
  return {std::atan2(east, north), std::asin(std::clamp(up, -1.0, 1.0))};
}

Light daylight(const SunConfig& sun, const SkyConfig& sky, double season_overcast) {
  const double overcast = sky.overcast.value_or(season_overcast);
  const SunPosition p = sun.at ? sun_position(*sun.at)
                               : SunPosition{sun.azimuth_deg * kRadiansPerDegree,
                                             sun.elevation_deg * kRadiansPerDegree};
  Light light;
  light.towards_sun =
      Eigen::Vector3d(std::sin(p.azimuth) * std::cos(p.elevation),
                      std::cos(p.azimuth) * std::cos(p.elevation), std::sin(p.elevation))
          .cast<float>();
  // The disc sets within half a degree.
  const double risen = std::clamp(p.elevation / (0.5 * kRadiansPerDegree) + 0.5, 0.0, 1.0);
  const Eigen::Array3d through =
      transmission(p.elevation).array() / transmission(kNominalElevation).array();
  const double clear = 1 - overcast;
  light.sun = (risen * clear * clear * through).matrix().cast<float>();
  const double brightness = sky_brightness(p.elevation);
  const Eigen::Vector3d blue = brightness * light.sky.cast<double>();
  // Clouds scatter part of the sunlight and reduce the blue of the sky.
  const double cloud = brightness * (0.45 + 0.45 * std::sin(std::max(0.0, p.elevation)));
  light.sky = (blue + overcast * (Eigen::Vector3d(0.95, 1.0, 1.05) * cloud - blue)).cast<float>();
  const Eigen::Vector3f lit = light.sun * std::max(0.0f, light.towards_sun.z()) + light.sky;
  const Eigen::Vector3f nominal(1.216f, 1.266f, 1.366f);  // of the nominal light
  light.bounce = light.bounce.cwiseProduct(lit.cwiseQuotient(nominal));
  light.overcast = static_cast<float>(overcast);
  // Koschmieder: contrast is 2 % at extinction times distance = 3.912.
  light.haze = sky.visibility ? static_cast<float>(3.912 / *sky.visibility) : 0.0f;
  light.glare = static_cast<float>(sky.glare);
  return light;
}

Wind make_wind(const WindConfig& config, std::uint64_t seed) {
  const double heading = config.heading_deg * kRadiansPerDegree;
  Wind wind;
  wind.speed = static_cast<float>(config.speed);
  wind.towards = Eigen::Vector2d(std::cos(heading), std::sin(heading)).cast<float>();
  wind.seed = seed;
  return wind;
}

}  // namespace vinebench::sim
