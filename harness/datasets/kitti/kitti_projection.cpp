// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_projection.h"

namespace vinebench::harness {

bool is_projection(const Projection& P) {
  return P(0, 0) > 0 && P(1, 1) > 0 && P(2, 2) == 1;
}

RigCamera camera_of_projection(const Projection& P) {
  RigCamera camera;
  camera.model = {.fx = P(0, 0), .fy = P(1, 1), .cx = P(0, 2), .cy = P(1, 2)};
  // x = K (p + t) with the matrix's last column K t: the camera is at -t of the first camera.
  const Eigen::Vector3d t(P(0, 3) / P(0, 0) - P(0, 2) / P(0, 0) * P(2, 3),
                          P(1, 3) / P(1, 1) - P(1, 2) / P(1, 1) * P(2, 3), P(2, 3));
  camera.T_body_cam.translation = -t;
  return camera;
}

}  // namespace vinebench::harness
