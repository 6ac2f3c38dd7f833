// SPDX-License-Identifier: Apache-2.0
// listener-in-cpp PROFILES DOMAIN: the commanded positions of every executed cycle, mm and deg, with plain
// Fast DDS. PROFILES is fastdds.xml of the package trunnion-dev.
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "bus/fastdds/contract_type.hpp"
#include "contracts/topics.hpp"

int main(int argc, char** argv) {
  namespace dds = eprosima::fastdds::dds;
  namespace topics = trunnion::topics;
  if (argc != 3) return std::fputs("usage: listener-in-cpp PROFILES DOMAIN\n", stderr), 2;
  auto* factory = dds::DomainParticipantFactory::get_instance();
  factory->load_XML_profiles_file(argv[1]);
  auto* participant =
      factory->create_participant_with_profile(static_cast<std::uint32_t>(std::atoi(argv[2])), "trunnion");
  if (participant == nullptr) return std::fputs("listener-in-cpp: no participant\n", stderr), 1;
  dds::TypeSupport type(new trunnion::bus::ContractType(topics::feedback));
  type.register_type(participant);
  auto* topic =
      participant->create_topic(topics::feedback.name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  auto* reader = participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT)
                     ->create_datareader_with_profile(topic, "feedback");
  if (reader == nullptr) return std::fputs("listener-in-cpp: no reader\n", stderr), 1;
  trunnion::idl::stream::Feedback batch;
  for (dds::SampleInfo info; reader->wait_for_unread_message({3600, 0}); std::fflush(stdout))
    while (reader->take_next_sample(&batch, &info) == ReturnCode_t::RETCODE_OK)
      for (std::uint32_t row = 0; info.valid_data && row < batch.count; ++row) {
        std::printf("%llu", static_cast<unsigned long long>(batch.first + row));
        for (std::uint32_t axis = 0; axis < batch.axis_count; ++axis)
          std::printf(" %.17g", batch.commanded[row * batch.axis_count + axis]);
        std::printf("\n");
      }
  factory->delete_participant(participant);
}
