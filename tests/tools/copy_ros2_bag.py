# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Copies a bag of ROS 2 with PyPI's rosbags, as SQLite and as MCAP. Usage: copy_ros2_bag.py FROM TO"""
import pathlib
import sys

from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

source, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
types = get_typestore(Stores.ROS2_HUMBLE)
for plugin in (StoragePlugin.SQLITE3, StoragePlugin.MCAP):
    folder = target / plugin.name.lower()
    with Reader(source) as reader, Writer(folder, version=9, storage_plugin=plugin) as writer:
        copies = {c.id: writer.add_connection(c.topic, c.msgtype, typestore=types)
                  for c in reader.connections}
        for connection, time, raw in reader.messages():
            writer.write(copies[connection.id], time, raw)
