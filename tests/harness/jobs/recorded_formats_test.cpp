// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Recorded formats, read as strictly as by other tools.

#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>
#include <sstream>

#include "core/config/yaml.h"
#include "core/trajectory.h"
#include "harness/datasets/euroc/slam_settings.h"
#include "harness/datasets/open_recording.h"
#include "tests/support/recorded_folders.h"
#include "tests/support/small_scenario.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kFrameCount = 6;

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  EXPECT_EQ(text.find('\r'), std::string::npos) << file;
  EXPECT_TRUE(text.ends_with('\n')) << file;
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<double> numbers_of(const std::string& line, char separator) {
  std::vector<double> numbers;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, separator);) numbers.push_back(std::stod(field));
  return numbers;
}

class RecordedFormatsTest : public test::SmallScenario {
 protected:
  std::filesystem::path out() const { return request_.out; }
};

TEST_F(RecordedFormatsTest, Euroc) {
  record({"euroc", "tum"});
  const auto mav = out() / "euroc/mav0";
  const auto left = lines_of(mav / "cam0/data.csv");
  EXPECT_EQ(left.at(0), "#timestamp [ns],filename");
  ASSERT_EQ(left.size(), kFrameCount + 1);
  for (std::size_t i = 1; i < left.size(); ++i) {
    std::smatch parts;
    // 19 digits as EuRoC's own, so that sorted names are in order of time.
    ASSERT_TRUE(std::regex_match(left[i], parts, std::regex("([0-9]{19}),([0-9]{19})\\.png")))
        << left[i];
    EXPECT_EQ(parts[1], parts[2]);
    EXPECT_TRUE(std::filesystem::exists(mav / "cam0/data" / (parts[2].str() + ".png")));
  }
  EXPECT_EQ(lines_of(mav / "cam1/data.csv"), left);
  const auto times = lines_of(out() / "euroc/times.txt");
  ASSERT_EQ(times.size(), kFrameCount);
  EXPECT_EQ(times[1], "0000000000066666667");
  const auto imu = lines_of(mav / "imu0/data.csv");
  EXPECT_EQ(numbers_of(imu.at(1), ',').size(), 7u);
  EXPECT_EQ(imu.at(0).substr(0, 43), "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_");
  // An inertial reading no later than the first image, as systems that integrate up to it need.
  EXPECT_EQ(numbers_of(imu.at(1), ',')[0], 0);
  EXPECT_NEAR(numbers_of(imu.at(1), ',')[6], 9.81, 0.1);  // at rest; the bias has 0.02 m/s^2
  EXPECT_EQ(numbers_of(imu.at(2), ',')[0], 5e6);
  // 17 columns, w first: of a rover that hardly turns, w is near 1. TUM has it last.
  const auto tum = lines_of(out() / "tum/body.txt");
  std::map<double, std::vector<double>> truth;
  for (const std::string& line : lines_of(mav / "state_groundtruth_estimate0/data.csv")) {
    if (line.starts_with("#")) continue;
    truth[numbers_of(line, ',')[0]] = numbers_of(line, ',');
    ASSERT_EQ(numbers_of(line, ',').size(), 17u);
  }
  // 0 to 0.333333333 s at 200 Hz are 67 poses, from 0 on; of the six frames' stamps 0 and 0.2 s are
  // among them.
  EXPECT_EQ(truth.size(), 67u + 4u);
  for (std::size_t i = 0; i < kFrameCount; ++i) {
    const auto body = numbers_of(tum[i], ' ');
    ASSERT_EQ(body.size(), 8u);
    const auto at = truth.find(std::stod(left[i + 1]));
    ASSERT_NE(at, truth.end());
    const std::vector<double>& euroc = at->second;
    EXPECT_GT(euroc[4], 0.99);
    EXPECT_NEAR(euroc[4], body[7], 1e-9);
    EXPECT_NEAR(euroc[1], body[1], 1e-9);
    EXPECT_NEAR(euroc[0] * 1e-9, body[0], 1e-9);
  }
  const YAML::Node sensor = YAML::LoadFile((mav / "cam1/sensor.yaml").string());
  EXPECT_EQ(sensor["T_BS"]["data"].size(), 16u);
  EXPECT_EQ(sensor["camera_model"].as<std::string>(), "pinhole");
  EXPECT_NEAR(sensor["T_BS"]["data"][3].as<double>(), 0.27, 1e-12);
}

TEST_F(RecordedFormatsTest, SettingsOfOtherSystems) {
  record({"euroc"});
  const auto settings = out() / "euroc/settings";
  // As ORB-SLAM3 reads them: a float must be a real, the rate an integer.
  for (const char* name : {"orbslam3_rectified.yaml", "orbslam3_raw.yaml"}) {
    const cv::FileStorage file((settings / name).string(), cv::FileStorage::READ);
    ASSERT_TRUE(file.isOpened()) << name;
    EXPECT_EQ(std::string(file["File.version"]), "1.0");
    EXPECT_TRUE(file["Camera.fps"].isInt());
    EXPECT_TRUE(file["Camera.width"].isInt());
    for (const char* key : {"Camera1.fx", "Camera1.cy", "Stereo.ThDepth", "IMU.NoiseGyro",
                            "IMU.Frequency", "ORBextractor.scaleFactor", "Viewer.ViewpointF"}) {
      EXPECT_TRUE(file[key].isReal()) << name << ": " << key;
    }
    EXPECT_EQ(double(file["Camera1.fx"]), test::kFocal);
    cv::Mat T_b_c1;
    file["IMU.T_b_c1"] >> T_b_c1;
    EXPECT_EQ(T_b_c1.size(), cv::Size(4, 4));
    // Its type "Rectified" has no second camera, and it crashes when it prints that one.
    EXPECT_EQ(std::string(file["Camera.type"]), "PinHole") << name;
    EXPECT_TRUE(file["Camera2.fx"].isReal()) << name;
    EXPECT_EQ(double(file["Camera2.fx"]), test::kFocal) << name;
    cv::Mat T_c1_c2;
    file["Stereo.T_c1_c2"] >> T_c1_c2;
    ASSERT_EQ(T_c1_c2.size(), cv::Size(4, 4)) << name;
    // The right camera is on the right, and turned by nothing.
    EXPECT_NEAR(T_c1_c2.at<float>(0, 3), float(test::kBaseline), 1e-6f) << name;
    EXPECT_NEAR(cv::norm(T_c1_c2(cv::Rect(0, 0, 3, 3)) - cv::Mat::eye(3, 3, CV_32F)), 0, 1e-6);
    EXPECT_EQ(file["Camera1.k1"].empty(), std::string(name) == "orbslam3_rectified.yaml");
  }
  const auto basalt = nlohmann::json::parse(read_file(settings / "basalt_calib.json"))["value0"];
  EXPECT_EQ(basalt["T_imu_cam"].size(), 2u);  // Basalt reads a pair
  EXPECT_EQ(basalt["calib_gyro_bias"].size(), 12u);
  EXPECT_EQ(basalt["resolution"][1][0], 96);
  const cv::FileStorage chain((settings / "kalibr_imucam_chain.yaml").string(),
                              cv::FileStorage::READ);
  EXPECT_EQ(chain["cam1"]["T_cn_cnm1"].size(), 4u);
  EXPECT_NEAR(double(chain["cam1"]["T_cn_cnm1"][0][3]), -0.12, 1e-12);
  const YAML::Node stella = YAML::LoadFile((settings / "stella_vslam.yaml").string());
  EXPECT_NEAR(stella["Camera"]["focal_x_baseline"].as<double>(), 7.2, 1e-12);
}

TEST_F(RecordedFormatsTest, EurocsTruthHasTheBiases) {
  const auto rows = [&](const std::string& file) {
    std::map<double, std::vector<double>> all;
    for (const std::string& line : lines_of(out() / "euroc/mav0" / file)) {
      if (!line.starts_with("#")) all[numbers_of(line, ',')[0]] = numbers_of(line, ',');
    }
    return all;
  };
  const auto set = [&](const std::string& key, const char* value) {
    for (const char* sensor : {"gyroscope", "accelerometer"}) {
      request_.overrides.emplace_back(fmt::format("sensors.inertial.{}.{}", sensor, key), value);
    }
  };
  set("noise_density", "0");
  record({"euroc"});
  const auto biased = rows("imu0/data.csv");
  const auto truth = rows("state_groundtruth_estimate0/data.csv");
  for (const char* key : {"bias_random_walk", "bias_instability", "initial_bias"}) set(key, "0");
  request_.out = folder_ / "unbiased";
  record({"euroc"});
  int compared = 0;
  for (const auto& [stamp, exact] : rows("imu0/data.csv")) {
    if (stamp == 0) continue;  // before the first reading
    const std::vector<double>& reading = biased.at(stamp);
    const std::vector<double>& line = truth.at(stamp);
    // Without noise, readings with and without biases differ by these; columns 11 to 16 of the
    // truth, 1 to 6 of the readings. Texts are exact; the sums are rounded at 10 m/s^2, 2e-15.
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(reading[1 + i] - exact[1 + i], line[11 + i], 1e-14) << stamp;
    }
    EXPECT_NE(line[16], 0);
    ++compared;
  }
  EXPECT_GT(compared, 60);  // a third of a second at 200 Hz
}

// The velocities of the truth are those of its positions, between its lines and in the last one.
TEST_F(RecordedFormatsTest, EurocsTrueVelocitiesIntegrateToItsPositions) {
  record({"euroc"});
  std::vector<std::vector<double>> rows;
  for (const auto& line : lines_of(out() / "euroc/mav0/state_groundtruth_estimate0/data.csv")) {
    if (!line.starts_with("#")) rows.push_back(numbers_of(line, ','));
  }
  double x = rows.front()[1];
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double seconds = 1e-9 * (rows[i][0] - rows[i - 1][0]);
    EXPECT_GT(seconds, 0);
    x += seconds * (rows[i][8] + rows[i - 1][8]) / 2;
  }
  // At 2 m/s^2, the mean over 5 ms to either side errs by 10 mm/s for 5 ms at a jerk.
  EXPECT_GT(rows.back()[1] - rows.front()[1], 0.05);
  EXPECT_NEAR(x, rows.back()[1], 1e-4);
  EXPECT_GT(rows.back()[8], 0.3);
}

TEST_F(RecordedFormatsTest, BasaltHasACalibrationOfEachPair) {
  RecordingNotes notes;
  notes.rig = YamlDocument::load(std::string(VINEBENCH_SOURCE_DIR) + "/models/csl-rover/rig.yaml")
                  .read<RigConfig>();
  std::map<std::string, nlohmann::json> files;
  for (const SettingsFile& file : slam_settings(notes)) {
    if (file.name.starts_with("basalt") && file.name != "basalt_calib_rig.json")
      files[file.name] = nlohmann::json::parse(file.text);
  }
  ASSERT_EQ(files.size(), 2u);
  const Rig rig = notes.rig.make();
  for (const auto& [name, pair] :
       {std::pair("basalt_calib.json", 0), std::pair("basalt_calib_back.json", 1)}) {
    const auto& value = files.at(name)["value0"];
    ASSERT_EQ(value["T_imu_cam"].size(), 2u) << name;
    const StereoPair& cameras = rig.stereo_pairs[static_cast<std::size_t>(pair)];
    for (const auto& [i, camera] : {std::pair(0, cameras.left), std::pair(1, cameras.right)}) {
      EXPECT_EQ(value["T_imu_cam"][static_cast<std::size_t>(i)]["px"].get<double>(),
                rig.cameras[static_cast<std::size_t>(camera)].T_body_cam.translation.x());
    }
  }
}

TEST_F(RecordedFormatsTest, Kitti) {
  request_.options.colour = true;
  record({"kitti", "tum"});
  const auto calibration = lines_of(out() / "kitti/calib.txt");
  ASSERT_EQ(calibration.size(), 4u);
  EXPECT_TRUE(calibration[1].starts_with("P1: "));
  const auto P1 = numbers_of(calibration[1].substr(4), ' ');
  ASSERT_EQ(P1.size(), 12u);
  EXPECT_NEAR(P1[3], -test::kFocal * test::kBaseline, 1e-9);
  const auto poses = lines_of(out() / "kitti/poses.txt");
  ASSERT_EQ(poses.size(), kFrameCount);
  EXPECT_EQ(lines_of(out() / "kitti/times.txt").at(1), "0.066666667");
  const Trajectory left = read_tum(out() / "tum/left.txt");
  for (std::size_t i = 0; i < kFrameCount; ++i) {
    const auto p = numbers_of(poses[i], ' ');
    ASSERT_EQ(p.size(), 12u);
    const Eigen::Matrix4d T = (left[0].pose.inverse() * left[i].pose).matrix();
    // TUM's nine decimals.
    for (int k = 0; k < 12; ++k) EXPECT_NEAR(p[static_cast<std::size_t>(k)], T(k / 4, k % 4), 4e-9);
  }
  const cv::Mat grey = cv::imread((out() / "kitti/image_1/000005.png").string(), -1);
  const cv::Mat colour = cv::imread((out() / "kitti/image_3/000005.png").string(), -1);
  EXPECT_EQ(grey.type(), CV_8UC1);
  EXPECT_EQ(colour.type(), CV_8UC3);
  cv::Mat made_grey;
  cv::cvtColor(colour, made_grey, cv::COLOR_BGR2GRAY);
  EXPECT_EQ(cv::norm(grey, made_grey, cv::NORM_INF), 0);
}

TEST_F(RecordedFormatsTest, DcVslam) {
  record({"dcvslam"});
  const YAML::Node config = YAML::LoadFile((out() / "dcvslam/config.yaml").string());
  EXPECT_EQ(config["numOfFrames"].as<std::size_t>(), kFrameCount);
  EXPECT_EQ(config["Multi"]["T_c1_c2"]["data"].as<std::vector<float>>().size(), 16u);
  EXPECT_NEAR(config["Camera"]["bl"].as<float>(), 0.12f, 1e-6f);
  for (const char* key : {"Camera_l", "Camera_r", "CameraB_l", "CameraB_r"}) {
    EXPECT_EQ(config[key]["fx"].as<double>(), test::kFocal);
  }
  for (const char* camera : {"left", "right"}) {
    EXPECT_FALSE(cv::imread((out() / "dcvslam" / camera / "000005.png").string()).empty());
  }
  // The side camera sees the tag; its middle is where the corners' diagonals meet.
  const auto tags = lines_of(out() / "dcvslam/tags.csv");
  ASSERT_GT(tags.size(), 2u);
  EXPECT_TRUE(tags[0].starts_with("# the truth, not detections"));
  EXPECT_EQ(std::ranges::count(tags[2], ','), 20);
}

TEST_F(RecordedFormatsTest, EveryPoseGivesTheBodys) {
  record({"tum"});
  const Rig rig = load_rig(folder_ / "rig.yaml");
  const Trajectory body = read_tum(out() / "tum/body.txt");
  for (const RigCamera& camera : rig.cameras) {
    const Trajectory poses = read_tum(out() / "tum" / (camera.name + ".txt"));
    ASSERT_EQ(poses.size(), body.size());
    for (std::size_t i = 0; i < body.size(); ++i) {
      const Pose error = body[i].pose.inverse() * poses[i].pose * camera.T_body_cam.inverse();
      EXPECT_LT(error.translation.norm(), 5e-9);  // nine decimals
      EXPECT_LT(angle_of(error.rotation), 2e-8);
    }
  }
}

TEST_F(RecordedFormatsTest, AReplayGivesTheFramesOfTheRun) {
  record({"euroc", "kitti"});
  const ScenarioConfig scenario = load_scenario(request_.scenario);
  WorkerPool pool(1);
  const auto source =
      sim::make_simulation(scenario.simulation, 1, request_.machine.plant_cache, pool);
  const std::vector<Sample> euroc = test::play_all(out() / "euroc");
  const std::vector<Sample> kitti = test::play_all(out() / "kitti");
  ASSERT_EQ(euroc.size(), kFrameCount);
  ASSERT_EQ(kitti.size(), kFrameCount);
  for (std::size_t i = 0; i < kFrameCount; ++i) {
    const Frame run = source->next()->frame;
    EXPECT_EQ(euroc[i].frame.stamp, run.stamp);
    EXPECT_EQ(kitti[i].frame.stamp, run.stamp);
    for (std::size_t camera = 0; camera < 3; ++camera) {
      cv::Mat grey;
      cv::cvtColor(run.images[camera], grey, cv::COLOR_RGB2GRAY);
      EXPECT_EQ(cv::norm(grey, euroc[i].frame.images[camera], cv::NORM_INF), 0);
      if (camera < 2) {
        EXPECT_EQ(cv::norm(grey, kitti[i].frame.images[camera], cv::NORM_INF), 0);
      }
    }
    const std::size_t before = i == 0 ? 1 : 0;  // a recording has a reading at the start
    ASSERT_EQ(euroc[i].frame.imu.size(), run.imu.size() + before);
    for (std::size_t k = 0; k < run.imu.size(); ++k) {
      EXPECT_EQ(euroc[i].frame.imu[k + before].specific_force, run.imu[k].specific_force);
    }
  }
  const Rig rig = open_recording(out() / "kitti").rig;
  EXPECT_EQ(rig.cameras[0].model.fx, test::kFocal);
  EXPECT_NEAR(rig.baseline(rig.stereo_pairs[0]), test::kBaseline, 1e-15);
}

/// The path from the readings only: rates and accelerations integrated from the start.
TEST_F(RecordedFormatsTest, InertialReadingsIntegrateToTheTrajectory) {
  request_.overrides = {{"sensors.inertial",
                         "{gyroscope: {noise_density: 0, bias_random_walk: 0, "
                         "initial_bias: 0}, accelerometer: {noise_density: 0, "
                         "bias_random_walk: 0, initial_bias: 0}}"},
                        {"duration", "2"}};
  record({"euroc"});
  const Recording recording = open_recording(out() / "euroc");
  const Trajectory& truth = recording.truth;
  Pose T = truth.front().pose;
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Stamp now = 0;
  for (const ImuSample& reading : recording.imu) {
    const double dt = to_seconds(reading.stamp - now);
    now = reading.stamp;
    T.rotation = (T.rotation * exp_so3(reading.angular_velocity * dt)).normalized();
    const Eigen::Vector3d a = T.rotation * reading.specific_force - Eigen::Vector3d(0, 0, 9.81);
    T.translation += v * dt + 0.5 * a * dt * dt;
    v += a * dt;
  }
  const Pose error = truth.back().pose.inverse() * T;
  // A path of 1 m in 2 s, sampled at 200 Hz: 5 ms of an acceleration of 2 m/s^2 at each change of
  // it is 10 mm/s, over two seconds 20 mm.
  EXPECT_GT((truth.back().pose.translation - truth.front().pose.translation).norm(), 0.4);
  EXPECT_LT(error.translation.norm(), 0.04);
  EXPECT_LT(angle_of(error.rotation), 0.01);
}

}  // namespace
}  // namespace vinebench::harness
