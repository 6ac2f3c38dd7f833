// SPDX-License-Identifier: Apache-2.0
/* The DDS side: one participant, the topics of a compensation service, with the QoS that idl/topics.yaml asks for. */
#ifndef CLUSTER_H
#define CLUSTER_H

#include "dds/dds.h"
#include "parameters.h"
#include "service.h"
#include "stream.h"

struct options {
  unsigned instance, replica, domain;
  const char *machine;
  const char *interface_address, *peers; /* IPv4 addresses, the second separated by commas */
  int multicast, virtual_time, parent_bound, standby;
};

struct cluster {
  dds_entity_t participant, waitset;
  dds_entity_t input, feedback, parameters, promotions; /* readers */
  dds_entity_t output, progress, state, announcement, alarm; /* writers; output is 0 until the first parameters */
};

/* Returns 0, or -1 with a line on stderr. */
int cluster_open(struct cluster *c, const struct options *o);
/* The writer of the compensated batches: into the stream, or beside it on standby. */
int cluster_open_output(struct cluster *c, int standby);
void cluster_close(struct cluster *c);
void cluster_announce(const struct cluster *c, const struct options *o);
/* Waits for data, at most `milliseconds`. */
void cluster_wait(const struct cluster *c, int milliseconds);
/* Takes one sample into `sample`, whose sequences it may reuse; 1 when there was one. */
int cluster_take(dds_entity_t reader, void *sample);
int cluster_matched(dds_entity_t writer);

#endif
