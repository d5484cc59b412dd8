#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# A pcapng of two interfaces of different link types (Ethernet and Linux cooked, as a recording on several cards is) is
# refused by programs of libpcap, tcpdump among them. To part it, people filter with tshark (Debian's 4.0.17):
# `tshark -r two.pcapng -Y "frame.interface_id == 0" -w one.pcapng`. The new file holds the packets of the first
# interface alone, but the description of the second one as well. tcpdump 4.99.3 with libpcap 1.10.3 reads not even the
# first packet of it. `-F pcap` is no way out: tshark says that such a file "can't be written".
# Guess before: the description of an interface goes with its last packet.
# What follows: a reader by libpcap has to tell people to record again with one interface, for this filter parts nothing.
#
# Needs Debian 12 with apt-get download and dpkg. Everything lies in a temporary folder. Exit 0: as told here.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
version=4.0.17-0+deb12u3
# What tshark is linked with on a bare system, beside the C and C++ libraries.
apt-get download -q "tshark=$version" "wireshark-common=$version" "libwireshark16=$version" "libwiretap13=$version" \
  "libwsutil14=$version" "libwireshark-data=$version" tcpdump=4.99.3-1 libpcap0.8=1.10.3-1 \
  libbcg729-0 libbrotli1 libc-ares2 libcap2 libdbus-1-3 libelogind0 libffi8 libgcrypt20 libglib2.0-0 libgmp10 \
  libgnutls30 libgpg-error0 libgssapi-krb5-2 libhogweed6 libicu72 libidn2-0 libk5crypto3 libkeyutils1 libkrb5-3 \
  libkrb5support0 liblua5.2-0 liblz4-1 libmaxminddb0 libnettle8 libnghttp2-14 libnl-3-200 libnl-genl-3-200 libp11-kit0 \
  libpcre2-8-0 libsbc1 libsmi2ldbl libsnappy1v5 libspandsp2 libspeexdsp1 libssh-gcrypt-4 libssl3 libsystemd0 libtasn1-6 \
  libtiff6 libjpeg62-turbo libjbig0 libdeflate0 liblerc4 libwebp7 libunistring2 libxml2 libreadline8 > log 2>&1 ||
  { cat log; exit 2; }
for package in *.deb; do dpkg -x "$package" root; done
LD_LIBRARY_PATH=$(find "$work/root" -name 'lib*.so*' -exec dirname {} + | sort -u | tr '\n' ':')
PATH=$work/root/usr/bin:$PATH HOME=$work
export LD_LIBRARY_PATH PATH HOME

# One UDP datagram each: on Ethernet, and cooked (link type 113).
echo '0000 01 02 03 04 05 06 07 08' > ethernet.txt
text2pcap -q -F pcap -u 2368,2368 ethernet.txt ethernet.pcap > log 2>&1
printf '%s %s\n' '0000 00 00 00 01 00 06 00 00 00 00 00 00 00 00 08 00 45 00 00 1c 00 00 00 00 40 11 00 00' \
  '0a 00 00 01 0a 00 00 02 09 40 09 40 00 08 00 00' > cooked.txt
text2pcap -q -F pcap -l 113 cooked.txt cooked.pcap > log 2>&1
mergecap -a -w two.pcapng ethernet.pcap cooked.pcap
tshark -r two.pcapng -Y 'frame.interface_id == 0' -w one.pcapng 2> /dev/null

{
  tshark --version 2> /dev/null | head -1 | cut -d' ' -f1-3
  tcpdump --version 2>&1 | sed -n '1,2s/ (.*//; 1,2p'
  for file in two one; do
    echo "$file: packets of interface $(tshark -r $file.pcapng -T fields -e frame.interface_id 2> /dev/null | tr '\n' ' ')"
    # As root it would change to a user of its own, which a temporary folder has not.
    if [ "$(id -u)" = 0 ]; then set -- -Z root; else set --; fi
    tcpdump "$@" -nr $file.pcapng 2>&1 | grep -v '^reading from' || true
  done
  tshark -r two.pcapng -Y 'frame.interface_id == 0' -F pcap -w one.pcap 2>&1 | grep -v 'Running as user' || true
} | tee seen
cat > expected << 'SEEN'
TShark (Wireshark) 4.0.17
tcpdump version 4.99.3
libpcap version 1.10.3
two: packets of interface 0 1 
tcpdump: pcap_loop: an interface has a type 113 different from the type of the first interface
one: packets of interface 0 
tcpdump: pcap_loop: an interface has a type 113 different from the type of the first interface
tshark: The capture file being read can't be written as a "pcap" file.
SEEN
cmp seen expected
