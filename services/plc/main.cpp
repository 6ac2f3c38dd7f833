#include "service.hpp"

int main(int argc, char** argv) {
  using namespace trunnion;
  return node::service_main<plc::PlcService>(argc, argv, "plc");
}
