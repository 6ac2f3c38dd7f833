#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what services of other makers need beside the IDL: names and quality of service of the topics.

contract.h has the names of topics and types for C, cyclonedds.xml and fastdds.xml the settings with which a plain
participant of each vendor meets a cluster on this computer. The name of a type on the wire ends with its hash, so it is
taken from what the build has generated for C++.
"""
import argparse, os, re
from xml.sax.saxutils import escape

import yaml

ADDRESS = "127.0.0.1"  # a cluster without `network` in machine.yaml
KEPT = {"state": 1, "event": 64, "history": 16}  # samples per key; batches: all


def contract_of(service, topics, wire_types):
    """What libs/cluster/bus/contract.cpp computes."""
    lines = sorted(f"{t['name']} {wire_types[t['handle']]} {t['qos']}\n" for t in topics
                   if {service, "all"} & {*t["writers"], *t["readers"]})
    hash = 0xcbf29ce484222325
    for byte in "".join(lines).encode(): hash = (hash ^ byte) * 0x100000001b3 % 2**64
    return f"{hash:016x}"


def contract_header(text, topics):
    handles = re.findall(r'Topic<[^>]+> (\w+)\{"([^"]+)", "([^"]+)"', text)
    wire_types = {handle: wire_type for handle, _, wire_type in handles}
    services = sorted({name for t in topics for name in (*t["writers"], *t["readers"])} - {"all"})
    lines = ["/* Generated from idl/ by tools/generate_sdk.py. */", "#ifndef TRUNNION_CONTRACT_H", "#define TRUNNION_CONTRACT_H",
             f'#define TRUNNION_CONTRACT "{re.search(r"contract_hash = .(.+?).;", text).group(1)}"',
             f'#define TRUNNION_STANDBY_SUFFIX "{re.search(r"standby_suffix = .(.+?).;", text).group(1)}"']
    lines += [f'#define TRUNNION_CONTRACT_{name.upper()} "{contract_of(name, topics, wire_types)}"' for name in services]
    for handle, topic, wire_type in handles:
        lines += [f'#define TRUNNION_TOPIC_{handle.upper()} "{topic}"', f'#define TRUNNION_TYPE_{handle.upper()} "{wire_type}"']
    return "\n".join(lines + ["#endif", ""])


def cyclonedds_settings():
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<!-- For a plain Cyclone DDS participant: CYCLONEDDS_URI=file://.../cyclonedds.xml -->
<CycloneDDS>
  <Domain id="any">
    <General>
      <Interfaces><NetworkInterface address="{ADDRESS}"/></Interfaces>
      <AllowMulticast>false</AllowMulticast>
    </General>
    <Discovery>
      <ParticipantIndex>auto</ParticipantIndex>
      <MaxAutoParticipantIndex>39</MaxAutoParticipantIndex>
      <Peers><Peer address="{ADDRESS}"/></Peers>
      <SPDPInterval>0.5s</SPDPInterval>
      <LeaseDuration>3s</LeaseDuration>
    </Discovery>
    <Internal>
      <NackDelay>5ms</NackDelay>
      <HeartbeatInterval max="100ms">20ms</HeartbeatInterval>
    </Internal>
  </Domain>
</CycloneDDS>
"""


def fastdds_profile(topic, role):
    depth = KEPT.get(topic["qos"])
    history = f"<kind>KEEP_LAST</kind><depth>{depth}</depth>" if depth else "<kind>KEEP_ALL</kind>"
    durability = "VOLATILE" if topic["qos"] == "event" else "TRANSIENT_LOCAL"
    return f"""    <!-- {escape(topic["name"])}: {escape(topic["about"])} -->
    <data_{role} profile_name="{topic["handle"]}">
      <topic><historyQos>{history}</historyQos></topic>
      <qos>
        <reliability><kind>RELIABLE</kind></reliability>
        <durability><kind>{durability}</kind></durability>
        <data_sharing><kind>OFF</kind></data_sharing>
      </qos>
      <historyMemoryPolicy>PREALLOCATED_WITH_REALLOC</historyMemoryPolicy>
    </data_{role}>
"""


def fastdds_profiles(topics):
    readers = "".join(fastdds_profile(topic, "reader") for topic in topics)
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<!-- For a plain Fast DDS participant: profile trunnion, and a profile of each topic's reader by its handle. -->
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <profiles>
    <transport_descriptors>
      <transport_descriptor>
        <transport_id>trunnion_udp</transport_id>
        <type>UDPv4</type>
        <interfaceWhiteList><address>{ADDRESS}</address></interfaceWhiteList>
        <maxInitialPeersRange>40</maxInitialPeersRange>
      </transport_descriptor>
    </transport_descriptors>
    <participant profile_name="trunnion">
      <rtps>
        <userTransports><transport_id>trunnion_udp</transport_id></userTransports>
        <useBuiltinTransports>false</useBuiltinTransports>
        <builtin>
          <discovery_config>
            <leaseDuration><sec>3</sec></leaseDuration>
            <leaseAnnouncement><sec>0</sec><nanosec>500000000</nanosec></leaseAnnouncement>
          </discovery_config>
          <initialPeersList><locator><udpv4><address>{ADDRESS}</address></udpv4></locator></initialPeersList>
        </builtin>
      </rtps>
    </participant>
{readers}  </profiles>
</dds>
"""


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--topics", required=True, help="idl/topics.yaml")
    p.add_argument("--handles", required=True, help="the generated contracts/topics.hpp")
    p.add_argument("--out", required=True)
    args = p.parse_args()
    with open(args.topics) as f: topics = yaml.safe_load(f)["topics"]
    with open(args.handles) as f: handles = f.read()
    os.makedirs(args.out, exist_ok=True)
    for name, text in (("contract.h", contract_header(handles, topics)), ("cyclonedds.xml", cyclonedds_settings()),
                       ("fastdds.xml", fastdds_profiles(topics))):
        with open(os.path.join(args.out, name), "w") as f: f.write(text)


if __name__ == "__main__": main()
