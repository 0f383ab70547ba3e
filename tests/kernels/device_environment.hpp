// Starts the device for all tests of a program. Include in exactly one file of it.
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "kernels/device/device.hpp"

namespace rockfold {

class DeviceEnvironment : public testing::Environment {
 public:
  void SetUp() override { device_ = std::make_unique<DeviceScope>(); }
  void TearDown() override { device_.reset(); }

 private:
  std::unique_ptr<DeviceScope> device_;
};

inline testing::Environment* const device_environment =
    testing::AddGlobalTestEnvironment(new DeviceEnvironment);

}  // namespace rockfold
