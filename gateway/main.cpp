// SPDX-License-Identifier: Apache-2.0
#include "gateway_main.hpp"

int main(int argc, char** argv) { return trunnion::gateway_main(argc, argv); }
