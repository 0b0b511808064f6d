// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/config/config_field.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// The sun's position: explicit, or by place and time.
struct SunConfig {
  struct At {
    double latitude_deg = 45;         ///< north
    double longitude_deg = 10;        ///< east
    std::string date = "2026-09-15";  ///< YYYY-MM-DD
    std::string time = "12:00";       ///< UTC
    template <class Archive>
    void serialize(Archive& archive) {
      archive("latitude_deg", latitude_deg, Range::between(-90, 90));
      archive("longitude_deg", longitude_deg, Range::between(-180, 180));
      archive("date", date);
      archive("time", time);
      archive.require(is_date(date), "date", "expected YYYY-MM-DD");
      archive.require(is_time(time), "time", "expected HH:MM or HH:MM:SS");
    }
  };
  double azimuth_deg = 140;   ///< clockwise from north
  double elevation_deg = 50;  ///< above the horizon; below it, twilight
  std::optional<At> at;       ///< instead of azimuth and elevation
  template <class Archive>
  void serialize(Archive& archive) {
    archive("azimuth_deg", azimuth_deg, Range::between(-360, 360));
    archive("elevation_deg", elevation_deg, Range::between(-12, 90));
    archive("at", at);
  }

  static bool is_date(const std::string& text);
  static bool is_time(const std::string& text);
};

struct SkyConfig {
  std::optional<double> overcast;    ///< cloud cover, 0 to 1; if absent the season's
  std::optional<double> visibility;  ///< m at which contrast is 2 %; clear air if absent
  double glare = 1;  ///< strength of light scattered in the lens by a sun in the image, 0: none
  template <class Archive>
  void serialize(Archive& archive) {
    archive("overcast", overcast, Range::between(0, 1));
    archive("visibility", visibility, Range::between(5, 100000));
    archive("glare", glare, Range::between(0, 10));
  }
};

struct WindConfig {
  double speed = 0;        ///< m/s at the canopy; 0 is still air
  double heading_deg = 0;  ///< direction it blows to, counter-clockwise from east
  template <class Archive>
  void serialize(Archive& archive) {
    archive("speed", speed, Range::between(0, 25));
    archive("heading_deg", heading_deg, Range::between(-360, 360));
  }
};

/// Azimuth (clockwise from north) and elevation of the sun, rad.
struct SunPosition {
  double azimuth = 0;
  double elevation = 0;
};

/// The sun's position for a place and time, by the Astronomical Almanac's low-precision formulas
/// (Michalsky, Solar Energy 40, 1988), accurate to 0.01 degrees from 1950 to 2050; without
/// refraction. Throws Error for an invalid date or time.
SunPosition sun_position(const SunConfig::At& at);

/// The light of a sun and a sky. A camera at exposure 1 is set for a clear sky with the sun at 50
/// degrees; a lower sun is dimmer and redder, according to its air mass.
Light daylight(const SunConfig& sun, const SkyConfig& sky, double season_overcast = 0);

Wind make_wind(const WindConfig& config, std::uint64_t seed);

}  // namespace vinebench::sim
