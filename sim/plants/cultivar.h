// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "core/config/config_field.h"

namespace vinebench::sim {

/// The visible traits of a grape variety. Colours are sRGB, 0 to 1. The defaults are a red wine
/// grape of medium size; docs/plants.md has the sources.
struct Cultivar {
  struct Leaf {
    double area = 0.0105;     ///< m^2, mean of one side of a grown blade
    double variation = 0.18;  ///< standard deviation of the area, as a share of it
    double lobes = 0.5;       ///< depth of the sinuses: 0 an entire leaf, 1 cut to the veins
    double teeth = 0.5;       ///< height of the teeth: 0 smooth, 1 long and sharp
    Eigen::Vector3d dark{0.16, 0.25, 0.10};    ///< sRGB, 0 to 1, of blades: the darkest
    Eigen::Vector3d light{0.37, 0.49, 0.21};   ///< likewise: the lightest
    Eigen::Vector3d autumn{0.74, 0.52, 0.18};  ///< likewise: in autumn
    template <class Archive>
    void serialize(Archive& archive) {
      archive("area", area, Range::between(0.002, 0.04));
      archive("variation", variation, Range::between(0, 0.5));
      archive("lobes", lobes, Range::between(0, 1));
      archive("teeth", teeth, Range::between(0, 1));
      archive("dark", dark, Range::between(0, 1));
      archive("light", light, Range::between(0, 1));
      archive("autumn", autumn, Range::between(0, 1));
    }
  };
  struct Bunch {
    double length = 0.125;     ///< m, mean
    double width = 0.066;      ///< m, mean, at its widest
    double shoulder = 0.5;     ///< 0 a cylinder, 1 a cone with a wing
    double compactness = 0.8;  ///< 0 berries hang apart, 1 they press on each other
    template <class Archive>
    void serialize(Archive& archive) {
      archive("length", length, Range::between(0.04, 0.4));
      archive("width", width, Range::between(0.02, 0.3));
      archive("shoulder", shoulder, Range::between(0, 1));
      archive("compactness", compactness, Range::between(0, 1));
    }
  };
  struct Berry {
    double diameter = 0.015;                  ///< m, mean at harvest
    Eigen::Vector3d green{0.42, 0.54, 0.19};  ///< sRGB, 0 to 1, of a berry before veraison
    Eigen::Vector3d ripe{0.17, 0.13, 0.20};   ///< likewise: at harvest
    template <class Archive>
    void serialize(Archive& archive) {
      archive("diameter", diameter, Range::between(0.005, 0.035));
      archive("green", green, Range::between(0, 1));
      archive("ripe", ripe, Range::between(0, 1));
    }
  };

  std::string name = "red";  ///< of the cultivar
  Leaf leaf;
  Bunch bunch;
  Berry berry;
  double internode = 0.072;  ///< m between the leaves of a shoot
  double vigour = 1.0;       ///< multiplies the thickness of wood and shoots

  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("leaf", leaf);
    archive("bunch", bunch);
    archive("berry", berry);
    archive("internode", internode, Range::between(0.02, 0.25));
    archive("vigour", vigour, Range::between(0.3, 3));
    archive.require(bunch.width < bunch.length, "bunch", "expected to be longer than wide");
    archive.require(berry.diameter < bunch.width / 2, "berry", "expected two or more side by side");
  }
};

/// Reads a cultivar's file; the built-in cultivar if `file` is empty. Throws Error.
Cultivar load_cultivar(const std::filesystem::path& file);

}  // namespace vinebench::sim
