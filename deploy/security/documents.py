#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the DDS Security documents of a cluster from idl/topics.yaml: the governance and, for every identity, its name and
its permissions. deploy/security/make_certificates.sh signs them.

An identity is a service or an observer of libs/machine/machine/services.yaml on one vendor. What it may write and read is what
topics.yaml says, where `all` is every service; observers may read everything. Everything else is denied.
"""
import argparse, datetime, hashlib, os
import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
REGISTRY = os.path.join(HERE, "services.yaml")  # installed; else that of the sources
if not os.path.exists(REGISTRY): REGISTRY = os.path.join(HERE, "..", "..", "libs", "machine", "machine", "services.yaml")
VENDORS = {"cyclonedds": 0, "fastdds": 1}
SCHEMA = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_'

# Participants without a valid certificate are ignored. Discovery, data and the headers around them are encrypted or
# signed, so that a participant without a key cannot read, write, or make a reader believe that samples do not exist.
GOVERNANCE = f"""<?xml version="1.0" encoding="UTF-8"?>
<dds {SCHEMA}governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>100</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>NONE</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
"""


def der(tag, content):
    assert len(content) < 128
    return bytes([tag, len(content)]) + content


def subject_hash(common_name):
    """SHA-256 of the subject as encoded in the certificate: a name of one commonName (2.5.4.3) in UTF-8."""
    attribute = der(0x06, bytes([0x55, 0x04, 0x03])) + der(0x0C, common_name.encode())
    return hashlib.sha256(der(0x30, der(0x31, der(0x30, attribute)))).digest()


def common_name(service, vendor):
    """The participant's GUID begins with its subject's hash, and of two participants the one with the lower GUID begins the
    handshake. Of two vendors only Cyclone DDS may begin, so its names are those whose hash begins with a 0 bit."""
    for number in range(1000):
        name = f"{service}-{vendor}" + (f"-{number}" if number else "")
        if subject_hash(name)[0] >> 7 == VENDORS[vendor]: return name


def permissions(identity, observes, name, topics, suffix, days):
    def topic_list(side):
        names = []
        for t in topics:
            if identity in t[side] or ("all" in t[side] and not observes) or (side == "readers" and observes):
                names.append(t["name"])
                # A stage that is to replace another writes beside it, for the launcher to compare.
                if t["qos"] == "batch" and (side == "writers" or identity == "deploy"): names.append(t["name"] + suffix)
        verb = "publish" if side == "writers" else "subscribe"
        lines = "".join(f"            <topic>{n}</topic>\n" for n in names)
        return f"        <{verb}>\n          <topics>\n{lines}          </topics>\n        </{verb}>\n" if names else ""
    now = datetime.datetime.utcnow().replace(microsecond=0)
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<dds {SCHEMA}permissions.xsd">
  <permissions>
    <grant name="{name}">
      <subject_name>CN={name}</subject_name>
      <validity>
        <not_before>{(now - datetime.timedelta(days=1)).isoformat()}</not_before>
        <not_after>{(now + datetime.timedelta(days=days)).isoformat()}</not_after>
      </validity>
      <allow_rule>
        <domains><id_range><min>0</min><max>100</max></id_range></domains>
{topic_list("writers")}{topic_list("readers")}      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
"""


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("topics"), p.add_argument("directory"), p.add_argument("--days", type=int, default=3650)
    p.add_argument("--services", default=REGISTRY, help="services.yaml")
    args = p.parse_args()
    with open(args.topics) as f: document = yaml.safe_load(f)
    topics, suffix = document["topics"], document["standby_suffix"]
    with open(args.services) as f: registry = yaml.safe_load(f)
    services, observers = ([row["name"] for row in registry[key]] for key in ("services", "observers"))
    known = {*services, *observers, "all"}
    for t in topics:
        for service in t["writers"] + t["readers"]:
            if service not in known: raise SystemExit(f"{args.topics}: error: topic {t['name']} names the unknown service {service}")
    with open(os.path.join(args.directory, "governance.xml"), "w") as f: f.write(GOVERNANCE)
    for identity in services + observers:
        for vendor in VENDORS:
            directory = os.path.join(args.directory, f"{identity}-{vendor}")
            os.makedirs(directory, exist_ok=True)
            name = common_name(identity, vendor)
            with open(os.path.join(directory, "name"), "w") as f: f.write(name + "\n")
            with open(os.path.join(directory, "permissions.xml"), "w") as f: f.write(permissions(identity, identity in observers, name, topics, suffix, args.days))


if __name__ == "__main__":
    main()
