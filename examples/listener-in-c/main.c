// SPDX-License-Identifier: Apache-2.0
/* listener-in-c DOMAIN: the commanded positions of every executed cycle, mm and deg, with plain Cyclone DDS. */
#include <stdio.h>
#include <stdlib.h>

#include "contract.h"
#include "dds/dds.h"
#include "stream.h"

int main(int argc, char **argv) {
  const dds_entity_t participant = dds_create_participant(argc > 1 ? (dds_domainid_t)atoi(argv[1]) : 0, NULL, NULL);
  dds_topic_descriptor_t type = trunnion_stream_Feedback_desc;
  type.m_typename = TRUNNION_TYPE_FEEDBACK; /* with the hash of its IDL */
  const dds_entity_t topic = dds_create_topic(participant, &type, TRUNNION_TOPIC_FEEDBACK, NULL, NULL);
  dds_qos_t *qos = dds_create_qos(); /* as idl/topics.yaml states for batches */
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL), waitset = dds_create_waitset(participant);
  if (reader < 0) return fprintf(stderr, "listener-in-c: %s\n", dds_strretcode(reader)), 1;
  dds_waitset_attach(waitset, dds_create_readcondition(reader, DDS_ANY_STATE), 0);
  for (;; dds_waitset_wait(waitset, NULL, 0, DDS_INFINITY)) {
    void *sample = NULL; /* Cyclone lends one */
    for (dds_sample_info_t info; dds_take(reader, &sample, &info, 1, 1) == 1; dds_return_loan(reader, &sample, 1)) {
      const trunnion_stream_Feedback *batch = sample;
      for (uint32_t row = 0; info.valid_data && row < batch->count; ++row) {
        printf("%llu", (unsigned long long)(batch->first + row));
        for (uint32_t axis = 0; axis < batch->axis_count; ++axis)
          printf(" %.17g", batch->commanded._buffer[row * batch->axis_count + axis]);
        printf("\n");
      }
    }
    fflush(stdout);
  }
}
