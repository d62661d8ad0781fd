#include "runs/scene/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "core/error.hpp"
#include "runs/scene/scene_folder.hpp"

namespace acinus::runs {
namespace fs = std::filesystem;

std::string read_file(const std::string& path, std::size_t limit) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  check(fs::exists(status), fmt::format("{}: no such file", path), Exit::kFileError);
  check(fs::is_regular_file(status), fmt::format("{}: is not a regular file", path),
        Exit::kFileError);
  std::ifstream file(path, std::ios::binary);
  check(file.good(), fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)),
        Exit::kFileError);
  const std::uintmax_t size = fs::file_size(path, code);
  check(!code && size <= limit,
        fmt::format("{}: has {} bytes; at most {} are read", path, size, limit), Exit::kFileError);
  std::string text(size, '\0');
  file.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(file.gcount());
  check(!file.bad(), fmt::format("{}: cannot be read", path), Exit::kFileError);
  return text;
}

namespace {

/// Merges two values: objects are merged, everything else is replaced by that of `over`.
void merge(Node& base, Node&& over) {
  if (base.kind != Node::Kind::kObject || over.kind != Node::Kind::kObject) {
    base = std::move(over);
    return;
  }
  base.origin = over.origin;
  for (JsonMember& member : over.members) {
    if (Node* known = base.find(member.name)) {
      for (JsonMember& old : base.members) {
        if (&old.value == known) old.origin = member.origin;
      }
      merge(*known, std::move(member.value));
    } else {
      base.members.push_back(std::move(member));
    }
  }
}

void erase_member(Node& object, std::string_view name) {
  std::erase_if(object.members, [name](const JsonMember& member) { return member.name == name; });
}

/// Message for an extended file that does not exist, with advice if its name is a shipped scene.
std::string describe_missing(const fs::path& path) {
  const std::string name = path.stem().string(), folder = path.parent_path().string();
  const bool shipped = fs::is_regular_file(fs::path(scene_folder()) / (name + ".json"));
  return fmt::format("no such file: {}{}", path.string(),
                     shipped ? fmt::format(". Copy the shipped scene first, `acinus new {} {}`, "
                                           "and write \"{}.json\"",
                                           name, folder.empty() ? "." : folder, name)
                             : "");
}

/// Parses source number `source` and merges it over what it extends.
/// @param chain  files being read, outermost first
Node load(Document& document, int source, const std::string& text,
          std::vector<std::string>& chain) {
  Node node = parse_json(document.sources, source, text);
  if (node.kind != Node::Kind::kObject) {
    throw_complaints(document.sources,
                     {{node.origin, "", ": a scene is an object, { ... }, not " + shown(node)}});
  }
  erase_member(node, "$schema");
  const Node* extends = node.find("extends");
  if (extends == nullptr) return node;
  const TextPlace origin = extends->origin;
  const auto refuse = [&](const std::string& message) {
    throw_complaints(document.sources,
                     {{origin, "/extends", " = " + shown(*extends) + ": " + message}});
  };
  if (extends->kind != Node::Kind::kText || extends->text.empty()) {
    refuse("must be the path of a scene file, relative to this file");
  }
  const Source from = document.sources[source];
  const fs::path path = (fs::path(from.folder) / extends->text).lexically_normal();
  std::error_code code;
  if (!fs::is_regular_file(path, code)) refuse(describe_missing(path));
  const std::string identity = fs::weakly_canonical(path, code).string();
  if (std::find(chain.begin(), chain.end(), identity) != chain.end()) {
    refuse("the files extend each other in a circle");
  }
  if (chain.size() >= 16) refuse("more than 16 files extend one another");
  chain.push_back(identity);
  const std::string label =
      (fs::path(from.label).parent_path() / extends->text).lexically_normal().string();
  document.sources.push_back({label, path.parent_path().string(), false});
  const int base_source = static_cast<int>(document.sources.size()) - 1;
  Node base = load(document, base_source, read_file(path.string(), kMaxBytes), chain);
  chain.pop_back();
  erase_member(node, "extends");
  merge(base, std::move(node));
  return base;
}

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> parts;
  if (!path.empty() && path.front() == '/') path.remove_prefix(1);
  std::string part;
  for (const char c : path) {
    if (c == '.' || c == '/') {
      parts.push_back(std::move(part));
      part.clear();
    } else {
      part += c;
    }
  }
  parts.push_back(std::move(part));
  return parts;
}

/// Value at a path; blocks on the way are made when missing.
/// @param where  stands before what is wrong
Node& reach(Document& document, const std::vector<std::string>& parts, TextPlace origin,
            const std::string& where) {
  Node* target = &document.root;
  std::string pointer;
  for (const std::string& part : parts) {
    check(!part.empty(), where + ": the path has an empty name");
    if (target->kind == Node::Kind::kNull) {  // "capsule": null may be opened again
      *target = Node{};
      target->kind = Node::Kind::kObject;
      target->origin = origin;
    }
    if (target->kind == Node::Kind::kList) {
      std::size_t index = 0;
      const auto [end, code] = std::from_chars(part.data(), part.data() + part.size(), index);
      check(code == std::errc() && end == part.data() + part.size() && index < target->items.size(),
            fmt::format("{}: {} has {} elements, so \"{}\" must be a number {}", where,
                        pointer.empty() ? "/" : pointer, target->items.size(), part,
                        target->items.empty()
                            ? "that does not exist; set the whole list"
                            : fmt::format("from 0 to {}", target->items.size() - 1)));
      target = &target->items[index];
    } else {
      check(target->kind == Node::Kind::kObject,
            fmt::format("{}: {} = {} has no parts", where, pointer, shown(*target)));
      Node* next = target->find(part);
      if (next == nullptr) {
        target->members.push_back({part, origin, Node{}});
        next = &target->members.back().value;
        next->origin = origin;
      }
      target = next;
    }
    pointer += "/" + pointer_part(part);
  }
  return *target;
}

}  // namespace

Document read_document(const std::string& path) {
  std::error_code code;
  check(
      !fs::exists(fs::path(path) / "run.vtkhdf", code),
      fmt::format("{0}: is the folder of a run, not a scene. To go on with it: the command of the "
                  "run with --resume, or acinus run {0}/scene.json --out {0} --resume",
                  path),
      Exit::kFileError);
  const std::string text = read_file(path, kMaxBytes);
  Document document;
  const fs::path absolute = fs::absolute(path, code).lexically_normal();
  document.sources.push_back({path, absolute.parent_path().string(), false});
  std::vector<std::string> chain{fs::weakly_canonical(path, code).string()};
  document.root = load(document, 0, text, chain);
  return document;
}

Document parse_document(const std::string& text, const std::string& label,
                        const std::string& folder) {
  Document document;
  std::error_code code;
  const fs::path absolute = fs::absolute(folder.empty() ? "." : folder, code).lexically_normal();
  document.sources.push_back({label, absolute.string(), false});
  std::vector<std::string> chain{fs::weakly_canonical(absolute / label, code).string()};
  document.root = load(document, 0, text, chain);
  return document;
}

void apply_set(Document& document, const std::string& assignment) {
  const std::string flag = "--set " + assignment;
  check(is_utf8(assignment), "--set: the text is not UTF-8");
  const std::size_t equal = assignment.find('=');
  check(equal != std::string::npos && equal > 0,
        flag + ": must be PATH=VALUE, e.g. --set time.end=\"2 h\"");
  const std::string value_text = assignment.substr(equal + 1);
  const std::vector<std::string> parts = split_path(assignment.substr(0, equal));
  check(static_cast<int>(parts.size()) < kMaxDepth, flag + ": the path is too long");
  check(parts.front() != "extends", flag + ": extends cannot be changed from the command line");

  document.sources.push_back({flag, fs::current_path().string(), true});
  const int source = static_cast<int>(document.sources.size()) - 1;
  const TextPlace origin{source, 0, 0};
  // Text that looks like JSON must be JSON; anything else is a bare string.
  const bool looks_json = !value_text.empty() && std::strchr("{[\"", value_text.front());
  Node value;
  try {
    value = parse_json(document.sources, source, value_text);
  } catch (const Error&) {
    if (looks_json) throw;
    value.kind = Node::Kind::kText;
    value.text = value_text;
  }
  const std::function<void(Node&)> mark = [&](Node& node) {
    node.origin = origin;
    for (Node& item : node.items) mark(item);
    for (JsonMember& member : node.members) {
      member.origin = origin;
      mark(member.value);
    }
  };
  mark(value);
  reach(document, parts, origin, flag) = std::move(value);
}

void put_value(Document& document, const std::string& path, const JsonMember& value,
               const std::string& where) {
  const std::vector<std::string> parts = split_path(path);
  check(static_cast<int>(parts.size()) < kMaxDepth, where + ": the path is too long");
  check(parts.front() != "extends", where + ": extends cannot be changed here");
  reach(document, parts, value.origin, where) = value.value;
}

}  // namespace acinus::runs
