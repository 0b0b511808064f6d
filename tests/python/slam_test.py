# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The built-in core, frame by frame."""
import numpy as np

import vinebench as vb
from support import CourtTest, main


def plain(frame, **changes):
    """The same instant from arrays alone."""
    given = {"stamp": frame.stamp, "images": frame.images, "imu": frame.imu, "wheels": frame.wheels,
             "index": frame.index} | changes
    return vb.SensorFrame(given.pop("stamp"), given.pop("images"), **given)


class SlamTest(CourtTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.frames = list(vb.Scenario(cls.court))

    def poses(self, slam, frames):
        return np.array([slam.process(frame).T_map_body for frame in frames])

    def test_plain_arrays_give_what_frames_give(self):
        rig = self.folder / "rig.yaml"
        expected = self.poses(vb.Slam(rig), self.frames)
        self.assertEqual(expected.shape, (len(self.frames), 4, 4))
        for made in (plain, lambda f: f.sensors):
            found = self.poses(vb.Slam(rig, threads=1), [made(f) for f in self.frames])
            np.testing.assert_array_equal(found, expected)
        # Camera by camera in another order, and of arrays that are not contiguous.
        turned = [plain(f, images={name: np.asfortranarray(f.images[name])
                                   for name in ("right", "left")}) for f in self.frames]
        np.testing.assert_array_equal(self.poses(vb.Slam(rig), turned), expected)

    def test_images_may_have_stamps_of_their_own(self):
        frame = self.frames[1]
        self.assertEqual(frame.image_stamps, [frame.stamp] * len(frame.images))
        late = {"left": frame.stamp + 5_000_000, "right": frame.stamp + 5_000_000}
        given = plain(frame, image_stamps=late)
        self.assertEqual([given.image_stamps[list(given.images).index(name)] for name in late],
                         list(late.values()))
        rig = self.folder / "rig.yaml"
        frames = [plain(f, image_stamps={name: f.stamp for name in f.images}) for f in self.frames]
        np.testing.assert_array_equal(self.poses(vb.Slam(rig), frames),
                                      self.poses(vb.Slam(rig), self.frames))
        with self.assertRaisesRegex(ValueError, "image_stamps: 'top': expected ns of one of"):
            plain(frame, image_stamps={"top": 0})

    def test_an_estimate_says_how_it_came_about(self):
        slam = vb.Slam(vb.Rig.load(self.folder / "rig.yaml"))
        estimate = [slam.process(frame) for frame in self.frames[:3]][-1]
        self.assertEqual(estimate.stamp, self.frames[2].stamp)
        self.assertIs(estimate.status, vb.TrackingStatus.TRACKING)
        self.assertEqual(estimate.covariance.shape, (6, 6))
        np.testing.assert_allclose(estimate.covariance, estimate.covariance.T, atol=1e-15)
        self.assertGreater(estimate.cameras["left"].inliers, 20)
        self.assertEqual(estimate.tags, ())
        self.assertIsNone(estimate.loop_closure)
        self.assertIsNone(estimate.T_world_map)  # no tag
        self.assertEqual(slam.rig.name, "pair")
        summary = slam.finish()
        self.assertEqual(summary.trajectory.shape, (3, 8))
        self.assertGreater(len(summary.keyframes), 0)
        with self.assertRaisesRegex(vb.Error, "has finished"):
            slam.process(self.frames[3])

    def test_a_camera_may_deliver_nothing(self):
        slam = vb.Slam(self.folder / "rig.yaml")
        slam.process(self.frames[0])
        blind = slam.process(plain(self.frames[1], images={"left": None, "right": None}))
        self.assertEqual(blind.status, vb.TrackingStatus.DEAD_RECKONING)
        self.assertEqual(blind.cameras["left"].inliers, 0)

    def test_settings_are_those_of_a_scenario(self):
        few = vb.Slam(vb.Scenario(self.court), settings={"features": {"features": 150}})
        many = vb.Slam(vb.Scenario(self.court), settings={"features.features": 1500})
        counts = [slam.process(self.frames[0]).cameras["left"].features for slam in (few, many)]
        self.assertLess(counts[0], counts[1])

    def test_a_map_is_kept(self):
        slam = vb.Slam(self.folder / "rig.yaml")
        self.poses(slam, self.frames)
        slam.save_map(self.folder / "map")
        slam.save_cloud(self.folder / "cloud.ply")
        self.assertTrue((self.folder / "cloud.ply").read_bytes().startswith(b"ply"))
        again = vb.Slam(self.folder / "rig.yaml")
        again.load_map(self.folder / "map")
        self.assertIs(again.process(self.frames[0]).status, vb.TrackingStatus.INITIALIZING)
        with self.assertRaisesRegex(vb.Error, "before the first frame"):
            again.load_map(self.folder / "map")

    def test_bad_input_is_named(self):
        slam = vb.Slam(self.folder / "rig.yaml")
        slam.process(self.frames[1])
        grey = np.zeros((240, 376), np.uint8)
        imu = np.zeros((2, 7))
        cases = [
            (ValueError, "expected a stamp after", lambda: slam.process(self.frames[0])),
            (TypeError, "expected a Frame or a SensorFrame", lambda: slam.process(grey)),
            (TypeError, "expected dtype uint8, found float64",
             lambda: vb.SensorFrame(0, {"left": grey.astype(float)})),
            (ValueError, r"expected shape \(h, w\) or \(h, w, 3\), found \(240,\)",
             lambda: vb.SensorFrame(0, {"left": grey[:, 0]})),
            (TypeError, "expected a NumPy array, found list",
             lambda: vb.SensorFrame(0, {"left": [[1]]})),
            (ValueError, "'left': expected 376 x 240 px, found 376 x 120",
             lambda: slam.process(vb.SensorFrame(10**9, {"left": grey[:120]}))),
            (ValueError, "no camera named 'top'",
             lambda: slam.process(vb.SensorFrame(10**9, {"top": grey}))),
            (ValueError, r"imu: expected shape \(n, 7\), found \(2, 6\)",
             lambda: vb.SensorFrame(0, {}, imu=imu[:, 1:])),
            (ValueError, "imu: expected ascending", lambda: vb.SensorFrame(0, {}, imu=imu)),
            (ValueError, "wheels: expected finite",
             lambda: vb.SensorFrame(0, {}, wheels=np.full((1, 9), np.nan))),
            (vb.Error, "neither a file nor the name of a rig", lambda: vb.Slam("nowhere")),
            (vb.Error, "unknown key", lambda: vb.Slam(self.folder / "rig.yaml",
                                                      settings={"colour": 1})),
            (vb.Error, "none: cannot be read", lambda: vb.Slam(self.folder / "rig.yaml").load_map("none")),
        ]
        for kind, words, call in cases:
            with self.assertRaisesRegex(kind, words):
                call()


if __name__ == "__main__":
    main()
