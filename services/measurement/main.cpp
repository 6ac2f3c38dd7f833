// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

int main(int argc, char** argv) {
  using namespace trunnion;
  return service::service_main<measurement::MeasurementService>(argc, argv, "measurement");
}
