-- Puts a worker's report up in place of its last, and forgets the reports of workers that are gone.
--
-- KEYS[1]  farm:workers: hash from a worker's name to its report as JSON
-- KEYS[2]  farm:workers:seen: sorted set of workers' names; the score is when each last reported, in seconds of the
--          Unix epoch
-- ARGV[1]  the worker's name
-- ARGV[2]  the report as JSON
-- ARGV[3]  seconds after which a worker that has not reported is gone
-- Returns  1

local now = tonumber(redis.call('TIME')[1])
redis.call('HSET', KEYS[1], ARGV[1], ARGV[2])
redis.call('ZADD', KEYS[2], now, ARGV[1])

for _, old in ipairs(redis.call('ZRANGEBYSCORE', KEYS[2], '-inf', '(' .. (now - ARGV[3]))) do
    redis.call('HDEL', KEYS[1], old)
    redis.call('ZREM', KEYS[2], old)
end
return 1
