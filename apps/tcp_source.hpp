#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "apps/descriptor.hpp"
#include "apps/line_queue.hpp"
#include "apps/line_splitter.hpp"
#include "apps/message_source.hpp"

namespace sketchloc {

/// Messages from whoever connects to a port of this machine (127.0.0.1 only), one after the other;
/// the answers go back to them. Never at an end. A thread of its own reads and sends, so that
/// neither a slow reader nor a slow writer holds anybody up.
class TcpSource final : public MessageSource {
 public:
  /// Port 0: any that is free. Throws std::runtime_error where the port is taken or not allowed.
  explicit TcpSource(std::uint16_t port);
  ~TcpSource() override;

  std::uint16_t port() const { return port_; }

  std::vector<Arrival> receive(double wait_s) override;
  bool at_end() const override { return false; }
  void answer(std::string_view line) override;
  void answered_all() override;
  std::optional<std::string> complaint() override;

 private:
  void serve();
  void wait_for_client();
  void serve_client();
  void hang_up();
  bool read_some(LineSplitter& splitter);
  bool send_some();
  bool stopped() const;
  void leave(const std::string& why);

  std::uint16_t port_ = 0;
  std::size_t line_number_ = 0;
  Descriptor listener_;
  Descriptor client_;  ///< the thread's own
  LineQueue lines_;
  WakeUp wake_;
  mutable std::mutex mutex_;  ///< of all below
  std::string outbox_;
  bool connected_ = false;
  bool answered_all_ = false;
  bool stopped_ = false;
  std::optional<std::string> complaint_;
  std::thread thread_;  // last, so that everything else is there before it starts
};

}  // namespace sketchloc
