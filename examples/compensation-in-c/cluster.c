// SPDX-License-Identifier: Apache-2.0
#include "cluster.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "contract.h"

enum { stream_depth = 1024 };

/* What Cyclone reads at the start; 0 when the list of peers is too long for it. */
static int configure(char *text, size_t size, const struct options *o) {
  char peers[1024] = "";
  size_t used = 0;
  for (const char *p = o->multicast ? "" : o->peers; *p != 0;) {
    const int length = (int)strcspn(p, ",");
    used += (size_t)snprintf(peers + used, sizeof peers - used, "<Peer address=\"%.*s\"/>", length, p);
    if (used >= sizeof peers) return 0;
    p += length + (p[length] == ',');
  }
  return (size_t)snprintf(
             text, size,
             "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface address=\"%s\"/></Interfaces>"
             "<AllowMulticast>%s</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
             "<MaxAutoParticipantIndex>39</MaxAutoParticipantIndex><Peers>%s</Peers><SPDPInterval>0.5s</SPDPInterval>"
             "<LeaseDuration>3s</LeaseDuration></Discovery><Internal><Watermarks><WhcHigh>64MB</WhcHigh></Watermarks>"
             "<NackDelay>5ms</NackDelay><HeartbeatInterval max=\"100ms\">20ms</HeartbeatInterval></Internal></Domain>"
             "</CycloneDDS>",
             o->interface_address, o->multicast ? "spdp" : "false", peers) < size;
}

/* The hash of a type is part of its name on the wire, so that types that differ never meet. */
static dds_entity_t make_topic(dds_entity_t participant, const dds_topic_descriptor_t *type, const char *wire_type,
                               const char *name) {
  dds_topic_descriptor_t renamed = *type;
  renamed.m_typename = wire_type;
  return dds_create_topic(participant, &renamed, name, NULL, NULL);
}

static dds_qos_t *make_qos(int depth, int writer) {
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL, depth);
  if (writer) {
    dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, depth, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED);
    dds_qset_writer_data_lifecycle(qos, false);
  }
  return qos;
}

static dds_entity_t make_reader(const struct cluster *c, const dds_topic_descriptor_t *type, const char *wire_type,
                                const char *name, int depth) {
  dds_qos_t *qos = make_qos(depth, 0);
  const dds_entity_t topic = make_topic(c->participant, type, wire_type, name);
  const dds_entity_t reader = topic < 0 ? topic : dds_create_reader(c->participant, topic, qos, NULL);
  dds_delete_qos(qos);
  if (reader < 0)
    fprintf(stderr, "compensation-in-c: reader of %s: %s\n", name, dds_strretcode(reader));
  else
    dds_waitset_attach(c->waitset, dds_create_readcondition(reader, DDS_ANY_STATE), 0);
  return reader;
}

static dds_entity_t make_writer(const struct cluster *c, const dds_topic_descriptor_t *type, const char *wire_type,
                                const char *name, int depth) {
  dds_qos_t *qos = make_qos(depth, 1);
  const dds_entity_t topic = make_topic(c->participant, type, wire_type, name);
  const dds_entity_t writer = topic < 0 ? topic : dds_create_writer(c->participant, topic, qos, NULL);
  dds_delete_qos(qos);
  if (writer < 0) fprintf(stderr, "compensation-in-c: writer of %s: %s\n", name, dds_strretcode(writer));
  return writer;
}

int cluster_open(struct cluster *c, const struct options *o) {
  char configuration[2048];
  memset(c, 0, sizeof *c);
  if (!configure(configuration, sizeof configuration, o)) {
    fprintf(stderr, "compensation-in-c: --interface or --peers is too long\n");
    return -1;
  }
  dds_create_domain(o->domain, configuration);
  c->participant = dds_create_participant(o->domain, NULL, NULL);
  if (c->participant < 0) {
    fprintf(stderr, "compensation-in-c: participant: %s\n", dds_strretcode(c->participant));
    return -1;
  }
  c->waitset = dds_create_waitset(c->participant);
  c->announcement = make_writer(c, &trunnion_service_Announcement_desc, TRUNNION_TYPE_ANNOUNCEMENT,
                                TRUNNION_TOPIC_ANNOUNCEMENT, 1);
  c->state = make_writer(c, &trunnion_service_ServiceState_desc, TRUNNION_TYPE_SERVICE_STATE,
                         TRUNNION_TOPIC_SERVICE_STATE, 1);
  c->alarm = make_writer(c, &trunnion_service_Alarm_desc, TRUNNION_TYPE_ALARM, TRUNNION_TOPIC_ALARM, 1);
  c->progress = make_writer(c, &trunnion_stream_StageProgress_desc, TRUNNION_TYPE_STAGE_PROGRESS,
                            TRUNNION_TOPIC_STAGE_PROGRESS, 1);
  c->parameters = make_reader(c, &trunnion_parameters_ParameterSet_desc, TRUNNION_TYPE_PARAMETER_SET,
                              TRUNNION_TOPIC_PARAMETER_SET, 1);
  c->promotions = make_reader(c, &trunnion_service_Promotion_desc, TRUNNION_TYPE_PROMOTION, TRUNNION_TOPIC_PROMOTION, 1);
  c->feedback = make_reader(c, &trunnion_stream_Feedback_desc, TRUNNION_TYPE_FEEDBACK,
                            TRUNNION_TOPIC_FEEDBACK, 0);
  c->input = make_reader(c, &trunnion_stream_AxisBatch_desc, TRUNNION_TYPE_KINEMATICS_BATCH,
                         TRUNNION_TOPIC_KINEMATICS_BATCH, 0);
  return c->announcement < 0 || c->state < 0 || c->alarm < 0 || c->progress < 0 || c->parameters < 0 || c->promotions < 0 ||
                 c->feedback < 0 || c->input < 0
             ? -1
             : 0;
}

int cluster_open_output(struct cluster *c, int standby) {
  if (c->output > 0) dds_delete(c->output);
  c->output = make_writer(c, &trunnion_stream_AxisBatch_desc, TRUNNION_TYPE_COMPENSATION_BATCH,
                          standby ? TRUNNION_TOPIC_COMPENSATION_BATCH TRUNNION_STANDBY_SUFFIX : TRUNNION_TOPIC_COMPENSATION_BATCH,
                          stream_depth);
  return c->output < 0 ? -1 : 0;
}

void cluster_close(struct cluster *c) { dds_delete(c->participant); }

void cluster_announce(const struct cluster *c, const struct options *o) {
  trunnion_service_Announcement a;
  memset(&a, 0, sizeof a);
  a.instance = o->instance;
  strcpy(a.service, "compensation");
  strcpy(a.vendor, "cyclonedds");
  gethostname(a.host, sizeof a.host - 1);
  a.pid = getpid();
  strcpy(a.contract, TRUNNION_CONTRACT_COMPENSATION);
  strcpy(a.version, "c-example-1");
  dds_write(c->announcement, &a);
}

void cluster_wait(const struct cluster *c, int milliseconds) {
  dds_attach_t triggered[4];
  dds_waitset_wait(c->waitset, triggered, 4, DDS_MSECS(milliseconds));
}

int cluster_take(dds_entity_t reader, void *sample) {
  void *samples[1] = {sample};
  dds_sample_info_t info;
  while (dds_take(reader, samples, &info, 1, 1) == 1)
    if (info.valid_data) return 1;
  return 0;
}

int cluster_matched(dds_entity_t writer) {
  dds_publication_matched_status_t status;
  return dds_get_publication_matched_status(writer, &status) == DDS_RETCODE_OK ? (int)status.current_count : 0;
}
