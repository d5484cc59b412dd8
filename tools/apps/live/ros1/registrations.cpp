// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros1/registrations.hpp"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <vector>

namespace pose_wall::tools::live {
namespace {

using XmlRpc::XmlRpcValue;

// A node answers about itself in no time.
constexpr double kOwnAnswer_s = 0.5;

bool ask_master(const char* call, const std::vector<std::string>& words, XmlRpcValue* answer) {
  XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  for (std::size_t i = 0; i < words.size(); ++i) request[static_cast<int>(i) + 1] = words[i];
  return ros::master::execute(call, request, response, *answer, false);
}

// [[topic, [node, ...]], ...]: what the API of the master says of publishers and of subscribers.
std::set<std::string> topics_of_this_node(XmlRpcValue& topics) {
  std::set<std::string> own;
  for (int i = 0; i < topics.size(); ++i) {
    XmlRpcValue& nodes = topics[i][1];
    for (int k = 0; k < nodes.size(); ++k) {
      if (static_cast<std::string>(nodes[k]) == ros::this_node::getName()) own.insert(topics[i][0]);
    }
  }
  return own;
}

// Calls this node as its master would.
bool ask_self(const char* call, const XmlRpcValue& request, XmlRpcValue* answer) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(ros::XMLRPCManager::instance()->getServerURI(), host, port)) return false;
  // The host's name is for others; here it need not be known.
  XmlRpc::XmlRpcClient self("127.0.0.1", static_cast<int>(port), "/");
  if (!self.executeNonBlock(call, request)) return false;
  const ros::WallTime until = ros::WallTime::now() + ros::WallDuration(kOwnAnswer_s);
  while (!self.executeCheckDone(*answer)) {
    if (ros::WallTime::now() > until) return false;
    ros::WallDuration(0.002).sleep();
  }
  return answer->getType() == XmlRpcValue::TypeArray && answer->size() == 3;
}

// The slave API: [[id, URI of the publisher, "i", transport, topic, connected], ...]
std::set<std::string> connected_publishers(const std::string& topic) {
  std::set<std::string> found;
  XmlRpcValue request, answer;
  request[0] = ros::this_node::getName();
  if (!ask_self("getBusInfo", request, &answer)) return found;
  XmlRpcValue& links = answer[2];
  for (int i = 0; i < links.size(); ++i) {
    if (links[i].size() < 5 || static_cast<std::string>(links[i][2]) != "i") continue;
    if (static_cast<std::string>(links[i][4]) == topic) found.insert(links[i][1]);
  }
  return found;
}

}  // namespace

std::optional<Registered> registered_topics() {
  XmlRpcValue state;
  if (!ask_master("getSystemState", {}, &state)) return std::nullopt;
  try {
    return Registered{topics_of_this_node(state[0]), topics_of_this_node(state[1])};
  } catch (const XmlRpc::XmlRpcException&) {
    return std::nullopt;  // whoever answers there is no master
  }
}

bool is_replaced() {
  XmlRpcValue uri;
  if (!ask_master("lookupNode", {ros::this_node::getName()}, &uri)) return false;
  return uri.getType() == XmlRpcValue::TypeString &&
         static_cast<std::string>(uri) != ros::XMLRPCManager::instance()->getServerURI();
}

void register_publisher(const std::string& topic, const std::string& type) {
  XmlRpcValue subscribers;
  ask_master("registerPublisher", {topic, type, ros::XMLRPCManager::instance()->getServerURI()}, &subscribers);
}

void register_subscriber(const std::string& topic) {
  XmlRpcValue publishers;
  if (!ask_master("registerSubscriber", {topic, "*", ros::XMLRPCManager::instance()->getServerURI()}, &publishers)) {
    return;
  }
  try {
    if (publishers.size() == 0) return;
    // roscpp hangs up on whom the list does not name.
    std::set<std::string> all = connected_publishers(topic);
    for (int i = 0; i < publishers.size(); ++i) all.insert(publishers[i]);
    XmlRpcValue request, answer;
    request[0] = ros::this_node::getName();
    request[1] = topic;
    int count = 0;
    for (const std::string& uri : all) request[2][count++] = uri;
    ask_self("publisherUpdate", request, &answer);
  } catch (const XmlRpc::XmlRpcException&) {
    return;  // as above; the next look finds out
  }
}

}  // namespace pose_wall::tools::live
